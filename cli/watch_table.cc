// Rows and columns.
#include "cli/watch_table.h"

#include <algorithm>
#include <map>
#include <vector>

#include "base/log.h"
#include "base/printable.h"
#include "proto/module_ranges.h"

namespace lfd {
namespace {

constexpr std::size_t kStages = 3;
constexpr const char* kRow = "{:<12} {:<8} {:<10} {:>6} {:>8} {:>5} {:>9}  {}\n";

std::string ms_text(double ms) { return ms > 0 ? fmt::format("{:.1f}", ms) : "-"; }

std::string bytes_text(double per_second) {
  if (per_second < 0) return "-";
  if (per_second >= 1e6) return fmt::format("{:.1f} MB", per_second / 1e6);
  return fmt::format("{:.1f} kB", per_second / 1e3);
}

std::string up_text(double s) {
  const auto minutes = static_cast<long>(s / 60);
  if (minutes < 1) return fmt::format("{:.0f} s", s);
  return minutes < 60 ? fmt::format("{} min", minutes) : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

std::string cluster_lines(const proto::Status& status) {
  std::string lines =
      fmt::format("{}: {}, up {}\n", printable(status.deployment()), printable(status.scene()), up_text(status.up_s()));
  lines += fmt::format("frame {}, {:.1f} fps, {} late, {} of {} modules stale\n", status.frame(),
                       status.frames_per_second(), status.late_frames(), status.stale_modules(), status.module_count());
  lines +=
      fmt::format("begin to swap {} ms, to shown {} ms, state {} (update {})\n", ms_text(status.begin_to_swap_ms()),
                  ms_text(status.begin_to_shown_ms()), printable(status.state_hash().substr(0, 8)), status.sequence());
  lines += fmt::format("last fault: {}\n", status.last_fault().empty() ? "none" : printable(status.last_fault()));
  return lines;
}

}  // namespace

std::string stages_text(const proto::PeerStatus& peer, std::size_t most) {
  std::map<std::string, double> ms;  // a pass may be several entries, one for each module
  for (const proto::PassTime& pass : peer.pass()) ms[pass.pass()] += pass.gpu_ms() > 0 ? pass.gpu_ms() : pass.cpu_ms();
  std::vector<std::pair<std::string, double>> stages(ms.begin(), ms.end());
  std::ranges::stable_sort(stages, std::greater(), &std::pair<std::string, double>::second);
  if (stages.size() > most) stages.resize(most);
  std::string text;
  for (const auto& [pass, sum] : stages)
    text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", printable(pass), sum);
  return text;
}

std::string choices_text(const proto::Status& status) {
  std::string text;
  for (const proto::PeerStatus& peer : status.peer()) {
    if (!peer.occlusion_choice().empty())
      text += fmt::format("occlusion of \"{}\": {}\n", printable(peer.name()), printable(peer.occlusion_choice()));
  }
  return text;
}

double WatchTable::bytes_per_second(const proto::PeerStatus& peer, Clock::time_point now) const {
  if (!last_ || now <= last_at_) return -1;
  const auto before = std::ranges::find(last_->peer(), peer.name(), [](const auto& one) { return one.name(); });
  if (before == last_->peer().end() || before->image_bytes() > peer.image_bytes()) return -1;
  return static_cast<double>(peer.image_bytes() - before->image_bytes()) /
         std::chrono::duration<double>(now - last_at_).count();
}

std::string WatchTable::rows(const proto::Status& status, Clock::time_point now) const {
  std::string rows =
      fmt::format(kRow, "peer", "state", "modules", "fps", "ready ms", "stale", "images/s", "stages, ms");
  for (const proto::PeerStatus& peer : status.peer()) {
    const bool is_node = peer.role() == proto::NODE;
    const std::string modules = module_ranges(std::vector<int>(peer.module().begin(), peer.module().end()));
    rows += fmt::format(kRow, printable(peer.name()), printable(peer.state()),
                        peer.spare() ? "spare" + (modules.empty() ? "" : " " + modules) : modules,
                        fmt::format("{:.1f}", peer.frames_per_second()), ms_text(peer.begin_to_ready_ms()),
                        is_node ? std::to_string(peer.stale_modules()) : "",
                        is_node ? bytes_text(bytes_per_second(peer, now)) : "", stages_text(peer, kStages));
  }
  for (const proto::PeerStatus& peer : status.peer()) {
    if (!peer.last_fault().empty())
      rows += fmt::format("last fault of \"{}\": {}\n", printable(peer.name()), printable(peer.last_fault()));
  }
  return rows;
}

std::string WatchTable::answered(const proto::Status& status, Clock::time_point now) {
  std::string news;
  const bool is_anew = last_ && status.up_s() < last_->up_s();
  if (away_since_ || is_anew) {
    news = is_anew ? "the controller was started anew" : "the controller answers again";
    if (away_since_) news += fmt::format(", after {:.0f} s", milliseconds(now - *away_since_) / 1000);
    news += "\n";
  }
  if (is_anew) last_.reset();
  last_table_ = cluster_lines(status) + choices_text(status) + "\n" + rows(status, now);
  last_ = status;
  last_at_ = now;
  away_since_.reset();
  return news + last_table_;
}

std::string WatchTable::unanswered(Clock::time_point now, bool whole) {
  if (!away_since_) away_since_ = now;
  const std::string news =
      fmt::format("the controller does not answer{}; waiting for it\n",
                  now > *away_since_ ? fmt::format(", for {:.0f} s", milliseconds(now - *away_since_) / 1000) : "");
  return whole && !last_table_.empty() ? news + "it said last:\n" + last_table_ : news;
}

}  // namespace lfd
