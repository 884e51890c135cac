// Names and values of the controller's metrics.
#include "controller/cluster_page.h"

#include "base/version.h"

namespace lfd::controller {
namespace {

void add_cluster(MetricPage& page, const proto::Status& status, const ClusterStats& stats) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  page.gauge("lfd_controller_build_info", "1, with the version.", 1, {{"version", kVersion}});
  page.gauge("lfd_controller_up_seconds", "Since the controller's start.", status.up_s());
  page.counter("lfd_controller_frames_total", "Frames swapped.", number(stats.swapped_frames()));
  page.counter("lfd_controller_shown_frames_total", "Frames the display has shown.", number(status.shown_frames()));
  page.counter("lfd_controller_late_frames_total", "Frames that the deadline swapped.", number(status.late_frames()));
  page.gauge("lfd_controller_frames_per_second", "Over the last seconds.", status.frames_per_second());
  page.gauge("lfd_controller_modules", "Modules of the display.", status.module_count());
  page.gauge("lfd_controller_stale_modules", "Modules without a picture of the last frame.", status.stale_modules());
  page.gauge("lfd_controller_state_sequence", "Number of the last update.", number(status.sequence()));
  page.histogram("lfd_controller_begin_to_swap_seconds", "From a frame's begin to its swap.", stats.begin_to_swap());
  page.histogram("lfd_controller_begin_to_shown_seconds", "From a frame's begin until it is shown.",
                 stats.begin_to_shown());
  page.counter("lfd_controller_published_bytes_total", "Sent on the state channel.", number(status.published_bytes()));
  page.counter("lfd_controller_refused_messages_total", "Messages and joins that were refused.",
               number(status.refused_messages()));
  page.counter("lfd_controller_faults_total", "What was warned of.", number(stats.faults("")));
}

void add_peer(MetricPage& page, const proto::PeerStatus& peer, const ClusterStats& stats) {
  const MetricLabels labels{{"peer", peer.name()}, {"role", peer.role() == proto::NODE ? "node" : "display"}};
  const bool takes_part = peer.state() == "ready" || peer.state() == "late";
  page.gauge("lfd_controller_peer_ready", "1: it takes part in frames.", takes_part ? 1 : 0, labels);
  page.counter("lfd_controller_peer_faults_total", "What was warned of it.",
               static_cast<double>(stats.faults(peer.name())), labels);
  page.gauge("lfd_controller_peer_frames_per_second", "Over the last seconds.", peer.frames_per_second(), labels);
  if (peer.role() != proto::NODE) return;
  page.gauge("lfd_controller_peer_modules", "Modules it draws.", peer.module_size(), labels);
  page.gauge("lfd_controller_peer_stale_modules", "Modules of it without a picture of the last frame.",
             peer.stale_modules(), labels);
  page.gauge("lfd_controller_peer_begin_to_ready_seconds", "Of its last frame.", peer.begin_to_ready_ms() / 1000,
             labels);
  page.counter("lfd_controller_peer_image_bytes_total", "Of its images, as they travel.",
               static_cast<double>(peer.image_bytes()), labels);
}

}  // namespace

MetricPage cluster_page(const proto::Status& status, const ClusterStats& stats) {
  MetricPage page;
  add_cluster(page, status, stats);
  for (const proto::PeerStatus& peer : status.peer()) add_peer(page, peer, stats);
  return page;
}

}  // namespace lfd::controller
