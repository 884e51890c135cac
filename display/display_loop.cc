// The loop and the controller's words.
#include "display/display_loop.h"

#include <unistd.h>

#include "base/log.h"
#include "base/version.h"
#include "proto/calibration_file.h"
#include "proto/wire/poll.h"

namespace lfd::display {
namespace {

using namespace std::chrono_literals;

constexpr auto kJoinPause = 300ms;
constexpr auto kTick = 100ms;
constexpr auto kLookPause = 500ms;
constexpr auto kLastWords = 200ms;
constexpr int kSilentHeartbeats = 6;  // then the controller counts as away

std::span<const std::uint32_t> span_of(const google::protobuf::RepeatedField<std::uint32_t>& numbers) {
  return {numbers.data(), static_cast<std::size_t>(numbers.size())};
}

}  // namespace

Status DisplayLoop::run(StopSignals& signals) {
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

void DisplayLoop::wait_for_something(StopSignals& signals) {
  std::vector<const wire::Socket*> sockets = {&images_, &control_};
  std::vector<int> descriptors = {signals.descriptor()};
  if (state_) sockets.push_back(&*state_);
  if (writer_) descriptors.push_back(writer_->descriptor());
  wire::wait(sockets, descriptors, kTick);
}

void DisplayLoop::serve(Clock::time_point now) {
  service_.alive(now);
  if (now < next_look_) return;
  next_look_ = now + kLookPause;
  service_.status(fmt::format("{} {}", welcome_ ? "shows the frames of" : "joins", control_.endpoint()));
  if (metrics_ == nullptr) return;
  metrics_->publish(stats_.page(options_.name, {.is_member = welcome_,
                                                .nodes = senders_.peers().size(),
                                                .dropped_frames = assembly_.dropped_frames(),
                                                .refused_images = refused_images_,
                                                .failed_pictures = writer_ ? writer_->failed_images() : 0}));
}

void DisplayLoop::join_or_beat(Clock::time_point now) {
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
  if (welcome_) words.set_session(session_);
  if (const Status sent = control_.send(words); !sent) log::trace("{}", sent.error().message());
  next_words_ = now + (welcome_ ? heartbeat_ : Clock::duration(kJoinPause));
}

Status DisplayLoop::hear_control() {
  while (const auto message = control_.receive()) {
    last_heard_ = Clock::now();
    const auto& envelope = message->envelope;
    if (envelope.has_refused()) LFD_TRY_STATUS(take_refusal(envelope.refused()));
    if (envelope.has_welcome() && !welcome_) LFD_TRY_STATUS(welcome(envelope));
    if (envelope.has_quit()) ended_ = true;
  }
  return {};
}

Status DisplayLoop::take_refusal(const proto::Refused& refused) {
  LFD_TRY(const bool joins_again, refusals_.heard(refused, welcome_, control_.endpoint(), next_words_));
  if (!joins_again) return {};
  log::warn("the controller knows this display no longer ({}); joining again", refused.reason());
  welcome_ = false;
  next_words_ = Clock::now();
  return {};
}

Status DisplayLoop::welcome(const proto::Envelope& envelope) {
  const proto::Welcome& message = envelope.welcome();
  const auto display = read_calibration(message.display());
  if (!display) return display.error().within("the controller's display");
  auto state = wire::connect_subscriber(context_, message.state_endpoint());
  if (!state) return state.error().within("the controller's state channel");
  state_ = std::move(*state);
  if (message.heartbeat_ms() > 0) heartbeat_ = std::chrono::milliseconds(message.heartbeat_ms());
  session_ = envelope.session();
  const std::size_t waiting_bytes = std::size_t{message.stream().waiting_mib()} << 20;
  peers_.restart(Clock::now());
  last_shown_.clear();
  assembly_.configure(static_cast<int>(display->modules.size()), display->image, span_of(message.modules()),
                      waiting_bytes > 0 ? waiting_bytes : FrameAssembly::kWaitingPerNode_bytes);
  welcome_ = true;
  refusals_.welcomed();
  stats_.joined(display->modules.size());
  service_.ready();
  next_words_ = Clock::now();
  log::info("joined: display \"{}\", {} modules of {} x {} pixels", display->name, display->modules.size(),
            display->image.width, display->image.height);
  return {};
}

bool DisplayLoop::is_of_another_session(const proto::Envelope& envelope) const {
  return envelope.session() != 0 && session_ != 0 && envelope.session() != session_;
}

void DisplayLoop::hear_state() {
  if (!state_) return;
  while (const auto message = state_->receive()) {
    const auto& envelope = message->envelope;
    if (is_of_another_session(envelope)) continue;
    last_heard_ = Clock::now();
    if (envelope.has_quit()) {
      log::info("the controller says quit: {}", envelope.quit().reason());
      ended_ = true;
    }
    if (envelope.has_swap()) hear_swap(envelope.swap());
  }
}

void DisplayLoop::hear_swap(const proto::SwapFrame& swap) {
  if (assembly_.is_past(swap.frame())) return say_fate_again(swap.frame());
  FrameAssembly::Owners owners;
  for (const proto::Share& share : swap.share()) {
    for (const std::uint32_t module : share.module()) owners[module] = share.node();
  }
  assembly_.swapped(swap.frame(), span_of(swap.stale_modules()), owners);
  if (swap.stale_modules_size() > 0)
    log::debug("frame {}: {} modules are stale", swap.frame(), swap.stale_modules_size());
}

}  // namespace lfd::display
