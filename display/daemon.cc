// Sockets, signals and clock around FrameAssembly and PictureWriter; they decide, this does.
#include "display/daemon.h"

#include <unistd.h>

#include <algorithm>

#include "base/clock.h"
#include "base/log.h"
#include "base/service.h"
#include "base/signals.h"
#include "base/version.h"
#include "display/display_stats.h"
#include "display/frame_assembly.h"
#include "display/picture_writer.h"
#include "display/senders.h"
#include "proto/calibration_file.h"
#include "proto/deployment_keys.h"
#include "proto/wire/poll.h"
#include "proto/wire/socket.h"

namespace lfd::display {
namespace {

using namespace std::chrono_literals;

constexpr auto kJoinPause = 300ms;
constexpr auto kTick = 100ms;
constexpr auto kLookPause = 500ms;
constexpr auto kLastWords = 200ms;
constexpr int kSilentHeartbeats = 6;  // then the controller counts as away
constexpr auto kWarningPause = 5s;

std::span<const std::uint32_t> span_of(const google::protobuf::RepeatedField<std::uint32_t>& numbers) {
  return {numbers.data(), static_cast<std::size_t>(numbers.size())};
}

class Daemon {
 public:
  Daemon(const DaemonOptions& options, wire::Context& context, wire::Socket images, wire::Socket control,
         MetricServer* metrics)
      : options_(options),
        context_(context),
        images_(std::move(images)),
        control_(std::move(control)),
        senders_(options.nodes, !is_local_endpoint(images_.endpoint())),
        metrics_(metrics) {
    if (options.out) writer_.emplace(*options.out);
  }

  Status run(StopSignals& signals);

 private:
  void wait_for_something(StopSignals& signals);
  void join_or_beat(Clock::time_point now);
  Status hear_control();
  Status welcome(const proto::Welcome& message);
  void hear_state();
  void hear_images();
  void hello(const wire::Message& message, Clock::time_point now);
  void forget_if_gone(const std::string& peer);
  void show();
  void say_shown(std::uint64_t frame, int fresh_modules);
  void give_credits();
  void warn_of_image(const Error& error);
  void serve(Clock::time_point now);  // the service manager and Prometheus

  const DaemonOptions& options_;
  wire::Context& context_;
  wire::Socket images_, control_;
  std::optional<wire::Socket> state_;
  std::optional<PictureWriter> writer_;
  FrameAssembly assembly_;
  Senders senders_;
  bool welcome_ = false, ended_ = false;
  bool told_shown_ = true;  // the controller could be told of the last frame
  Clock::duration heartbeat_ = 500ms;
  Clock::time_point next_words_{}, last_heard_{}, last_warning_{};
  std::uint64_t refused_images_ = 0;
  MetricServer* metrics_;  // may be null
  DisplayStats stats_;
  Service service_;
  Clock::time_point next_look_{};  // when those are told again
};

Status Daemon::run(StopSignals& signals) {
  log::info("images at {}, controller at {}", images_.endpoint(), control_.endpoint());
  while (!ended_) {
    wait_for_something(signals);
    if (signals.take()) break;
    LFD_TRY_STATUS(hear_control());
    hear_state();
    hear_images();
    show();
    give_credits();
    join_or_beat(Clock::now());
    serve(Clock::now());
  }
  service_.stopping();
  proto::Envelope leave;
  leave.mutable_leave()->set_reason(ended_ ? "the controller said quit" : "stopped by a signal");
  control_.linger(kLastWords);
  if (!control_.send(leave)) log::debug("the controller is away; it is not told");
  log::info("ends; {} frames dropped, {} images refused, {} pictures could not be written", assembly_.dropped_frames(),
            refused_images_, writer_ ? writer_->failed_images() : 0);
  return {};
}

void Daemon::wait_for_something(StopSignals& signals) {
  std::vector<const wire::Socket*> sockets = {&images_, &control_};
  std::vector<int> descriptors = {signals.descriptor()};
  if (state_) sockets.push_back(&*state_);
  if (writer_) descriptors.push_back(writer_->descriptor());
  wire::wait(sockets, descriptors, kTick);
}

void Daemon::serve(Clock::time_point now) {
  service_.alive(now);
  if (now < next_look_) return;
  next_look_ = now + kLookPause;
  service_.status(fmt::format("{} {}", welcome_ ? "shows the frames of" : "joins", control_.endpoint()));
  if (metrics_ == nullptr) return;
  metrics_->publish(stats_.page(options_.name, {.is_member = welcome_,
                                                .nodes = peer_of_node_.size(),
                                                .dropped_frames = assembly_.dropped_frames(),
                                                .refused_images = refused_images_,
                                                .failed_pictures = writer_ ? writer_->failed_images() : 0}));
}

void Daemon::join_or_beat(Clock::time_point now) {
  if (welcome_ && now - last_heard_ > kSilentHeartbeats * heartbeat_) {
    log::warn("nothing heard of the controller for {:.0f} ms; the last frame stays, joining again",
              milliseconds(now - last_heard_));
    welcome_ = false;
  }
  if (now < next_words_) return;
  proto::Envelope words;
  if (welcome_) {
    words.mutable_heartbeat();
  } else {
    auto* join = words.mutable_join();
    join->set_role(proto::DISPLAY);
    join->set_name(options_.name);
    join->set_version(kVersion);
    join->set_images_endpoint(images_.endpoint());
    join->set_calibration_hash(options_.calibration_hash);
    join->set_process(static_cast<std::uint64_t>(::getpid()));
  }
  if (const Status sent = control_.send(words); !sent) log::trace("{}", sent.error().message());
  next_words_ = now + (welcome_ ? heartbeat_ : Clock::duration(kJoinPause));
}

Status Daemon::hear_control() {
  while (const auto message = control_.receive()) {
    last_heard_ = Clock::now();
    const auto& envelope = message->envelope;
    if (envelope.has_refused() && !welcome_) {
      return Error(fmt::format("{}: refused: {}", control_.endpoint(), envelope.refused().reason()));
    }
    if (envelope.has_refused()) {
      log::warn("the controller knows this display no longer ({}); joining again", envelope.refused().reason());
      welcome_ = false;
      next_words_ = Clock::now();
    }
    if (envelope.has_welcome() && !welcome_) LFD_TRY_STATUS(welcome(envelope.welcome()));
    if (envelope.has_quit()) ended_ = true;
  }
  return {};
}

Status Daemon::welcome(const proto::Welcome& message) {
  const auto display = read_calibration(message.display());
  if (!display) return display.error().within("the controller's display");
  auto state = wire::connect_subscriber(context_, message.state_endpoint());
  if (!state) return state.error().within("the controller's state channel");
  state_ = std::move(*state);
  if (message.heartbeat_ms() > 0) heartbeat_ = std::chrono::milliseconds(message.heartbeat_ms());
  assembly_.configure(static_cast<int>(display->modules.size()), display->image, span_of(message.modules()));
  welcome_ = true;
  stats_.joined(display->modules.size());
  service_.ready();
  next_words_ = Clock::now();
  log::info("joined: display \"{}\", {} modules of {} x {} pixels", display->name, display->modules.size(),
            display->image.width, display->image.height);
  return {};
}

void Daemon::hear_state() {
  if (!state_) return;
  while (const auto message = state_->receive()) {
    last_heard_ = Clock::now();
    const auto& envelope = message->envelope;
    if (envelope.has_quit()) {
      log::info("the controller says quit: {}", envelope.quit().reason());
      ended_ = true;
    }
    if (!envelope.has_swap()) continue;
    const auto& swap = envelope.swap();
    assembly_.swapped(swap.frame(), span_of(swap.stale_modules()));
    if (swap.stale_modules_size() > 0)
      log::debug("frame {}: {} modules are stale", swap.frame(), swap.stale_modules_size());
  }
}

void Daemon::hear_images() {
  const Clock::time_point now = Clock::now();
  while (auto message = images_.receive()) {
    const auto& envelope = message->envelope;
    senders_.heard(message->peer, now);
    if (envelope.has_hello()) hello(*message, now);
    if (!envelope.has_image()) continue;
    stats_.image_came(message->payload.bytes().size());
    const bool past = assembly_.is_past(envelope.image().frame());
    const Status status = assembly_.image_came(message->peer, envelope.image(), std::move(message->payload), now);
    if (!status && past) log::debug("{}", status.error().message());  // as where a node joins before the display
    if (!status && !past) warn_of_image(status.error());
  }
}

void Daemon::hello(const wire::Message& message, Clock::time_point now) {
  const std::string& node = message.envelope.hello().node();
  if (const auto before = senders_.speaks_for(node); before && *before != message.peer) forget_if_gone(*before);
  const auto greeting = senders_.hello(message.peer, message.user, node, now);
  if (!greeting) return warn_of_image(greeting.error());
  if (!greeting->is_new) return;
  if (greeting->replaced) assembly_.node_left(*greeting->replaced);
  assembly_.node_came(message.peer);
  log::info("node \"{}\" sends images", node);
}

void Daemon::forget_if_gone(const std::string& peer) {
  proto::Envelope nothing;
  nothing.mutable_credit();
  if (images_.send_to(peer, nothing)) return;
  senders_.left(peer);
  assembly_.node_left(peer);
}

void Daemon::show() {
  while (writer_) {
    const auto written = writer_->take_written();
    if (!written) break;
    say_shown(written->frame, written->fresh_modules);
  }
  while (!writer_ || writer_->accepts()) {
    auto frame = assembly_.next_frame(Clock::now());
    if (!frame) break;
    if (writer_) {
      writer_->write(std::move(*frame));
    } else {
      say_shown(frame->frame, frame->fresh_modules);
    }
  }
}

void Daemon::say_shown(std::uint64_t frame, int fresh_modules) {
  stats_.shown(fresh_modules, Clock::now());
  proto::Envelope shown;
  shown.mutable_shown()->set_frame(frame);
  shown.mutable_shown()->set_modules(static_cast<std::uint32_t>(fresh_modules));
  const Status sent = control_.send(shown);
  if (!sent && told_shown_) log::warn("frame {} is shown, but: {}", frame, sent.error().message());
  told_shown_ = static_cast<bool>(sent);
}

void Daemon::give_credits() {
  for (const auto& [node, peer] : senders_.peers()) {
    const std::uint32_t images = assembly_.credit_for(peer);
    if (images == 0) continue;
    proto::Envelope credit;
    credit.mutable_credit()->set_images(images);
    const Status sent = images_.send_to(peer, credit);
    if (sent) continue;
    log::info("node \"{}\" sends no more images: {}", node, sent.error().message());
    assembly_.node_left(peer);
    senders_.left(peer);
  }
}

void Daemon::warn_of_image(const Error& error) {
  ++refused_images_;
  if (Clock::now() - last_warning_ < kWarningPause) return;
  last_warning_ = Clock::now();
  log::warn("{} (so far {} images refused)", error.message(), refused_images_);
}

// What is larger than any image of the display is not even taken in; packed, one may grow a little.
wire::Limits limits_for(const DaemonOptions& options) {
  wire::Limits limits = wire::kImages;
  if (!options.image) return limits;
  const std::int64_t largest = std::int64_t{16} * options.image->width * options.image->height;
  limits.max_part_bytes = std::min(limits.max_part_bytes, largest + largest / 64 + wire::kShort_bytes);
  return limits;
}

}  // namespace

Status run_daemon(const DaemonOptions& options) {
  StopSignals signals;
  LFD_TRY(const auto metrics, open_metrics("lfd-display", options.metrics));
  LFD_TRY(const auto context, wire::open_context(options.key_file));
  LFD_TRY(wire::Socket images,
          wire::bind_router(*context, options.images, limits_for(options), wire::Listener::kDisplay));
  LFD_TRY(wire::Socket control, wire::connect_dealer(*context, options.controller));
  Daemon daemon(options, *context, std::move(images), std::move(control), metrics.get());
  return daemon.run(signals);
}

}  // namespace lfd::display
