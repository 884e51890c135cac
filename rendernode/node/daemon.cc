// The node's loop: joining, and what the controller says to it alone.
#include "rendernode/node/daemon.h"

#include <unistd.h>

#include <algorithm>

#include "base/log.h"
#include "base/version.h"
#include "proto/calibration_file.h"
#include "proto/wire/poll.h"

namespace lfd::node {
namespace {

using namespace std::chrono_literals;

constexpr auto kJoinPause = 300ms;
constexpr auto kTick = 20ms;
constexpr auto kLastWords = 200ms;
constexpr auto kSnapshotPause = 500ms;
constexpr auto kLookPause = 500ms;
constexpr int kSilentHeartbeats = 6;  // then the controller counts as away

}  // namespace

Result<std::unique_ptr<Daemon>> Daemon::open(DaemonOptions options) {
  LFD_TRY(auto context, wire::open_context(options.key_file));
  LFD_TRY(wire::Socket control, wire::connect_dealer(*context, options.controller));
  return std::unique_ptr<Daemon>(new Daemon(std::move(options), std::move(context), std::move(control)));
}

Status Daemon::run(StopSignals& signals) {
  log::info("controller at {}", control_.endpoint());
  std::string reason = "the controller said quit";
  while (!ended_) {
    wait_for_something(signals);
    if (const auto signal = signals.take()) {
      reason = fmt::format("signal {}", *signal);
      break;
    }
    LFD_TRY_STATUS(hear_control());
    hear_state();
    hear_bulk();
    begin_frames();
    LFD_TRY_STATUS(take_events());
    hear_display();
    send_images();
    join_or_beat(Clock::now());
    serve(Clock::now());
  }
  service_.stopping();
  proto::Envelope leave;
  leave.mutable_leave()->set_reason(reason);
  control_.linger(kLastWords);
  say(leave);
  log::info("ends: {}; {} frames were dropped for a slow sink", reason, dropped_frames_);
  return {};
}

void Daemon::wait_for_something(const StopSignals& signals) const {
  std::vector<const wire::Socket*> sockets{&control_};
  for (const auto* socket : {&state_socket_, &bulk_, &images_}) {
    if (*socket) sockets.push_back(&**socket);
  }
  std::vector<int> descriptors{signals.descriptor(), encoder_.descriptor()};
  for (const RenderThread* thread :
       {drawing_.get(), finishing_.get(), preparation_ ? preparation_->drawing.get() : nullptr}) {
    if (thread != nullptr) descriptors.push_back(thread->descriptor());
  }
  wire::wait(sockets, descriptors, kTick);
}

void Daemon::say(proto::Envelope envelope) {
  envelope.set_session(session_);
  if (const Status sent = control_.send(envelope); !sent) log::debug("{}", sent.error().message());
}

void Daemon::serve(Clock::time_point now) {
  service_.alive(now);
  if (now < next_look_) return;
  next_look_ = now + kLookPause;
  service_.status(welcome_ ? fmt::format("\"{}\": draws for {}", options_.name, control_.endpoint())
                           : fmt::format("\"{}\": joins {}", options_.name, control_.endpoint()));
  if (!options_.metrics) return;
  options_.metrics->publish(stats_.page(options_.name, {.is_member = welcome_,
                                                        .sequence = ready_state_ ? ready_state_->sequence() : 0,
                                                        .dropped_frames = dropped_frames_}));
}

void Daemon::join_or_beat(Clock::time_point now) {
  if (welcome_ && now - last_heard_ > kSilentHeartbeats * heartbeat_) {
    log::warn("nothing heard of the controller for {:.0f} ms; joining again", milliseconds(now - last_heard_));
    welcome_ = false;
    gatherer_.ask_again();
  }
  if (welcome_ && follower_.has_gap() && now >= next_snapshot_request_) {
    next_snapshot_request_ = now + kSnapshotPause;
    proto::Envelope request;
    request.mutable_snapshot_request();
    say(request);
  }
  if (now < next_words_) return;
  next_words_ = now + (welcome_ ? heartbeat_ : Clock::duration(kJoinPause));
  proto::Envelope words;
  if (welcome_) {
    if (!gatherer_.complete()) follow_assets();
    words.mutable_heartbeat()->set_state_hash(hash_to_say());
    words.mutable_heartbeat()->set_share(share_);
  } else {
    auto* join = words.mutable_join();
    join->set_role(proto::NODE);
    join->set_name(options_.name);
    join->set_version(kVersion);
    join->set_calibration_hash(options_.calibration_hash);
    join->set_process(static_cast<std::uint64_t>(::getpid()));
  }
  say(words);
}

Status Daemon::hear_control() {
  while (const auto message = control_.receive()) {
    last_heard_ = Clock::now();
    const auto& envelope = message->envelope;
    if (envelope.has_refused()) LFD_TRY_STATUS(take_refusal(envelope.refused()));
    if (envelope.has_welcome() && !welcome_) LFD_TRY_STATUS(welcome(envelope.welcome(), envelope.session()));
    if (envelope.session() != session_) continue;
    if (envelope.has_assign()) {
      const auto& modules = envelope.assign().modules();
      log::info("draws modules of another node from now on");
      LFD_TRY_STATUS(take_share(envelope.assign().share(), *display_, {modules.begin(), modules.end()}));
    }
    if (envelope.has_prepare()) take_prepare(envelope.prepare());
    if (envelope.has_snapshot()) take_snapshot(envelope.snapshot());
    if (envelope.has_quit()) ended_ = true;
  }
  return {};
}

Status Daemon::take_refusal(const proto::Refused& refused) {
  LFD_TRY(const bool joins_again, refusals_.heard(refused, welcome_, control_.endpoint(), next_words_));
  if (!joins_again) return {};
  log::info("the controller does not know this node ({}); joining again", refused.reason());
  welcome_ = false;
  gatherer_.ask_again();
  next_words_ = Clock::now();
  return {};
}

Status Daemon::welcome(const proto::Welcome& message, std::uint64_t session) {
  LFD_TRY(state_socket_, wire::connect_subscriber(*context_, message.state_endpoint()));
  LFD_TRY(bulk_, wire::connect_dealer(*context_, message.bulk_endpoint(), wire::kChunks));
  auto display = read_calibration(message.display());
  if (!display) return display.error().within("the controller's display");
  session_ = session;
  prepared_shown_ = prepared_sequence_ = 0;  // that session numbers its scenes anew
  if (message.heartbeat_ms() > 0) heartbeat_ = std::chrono::milliseconds(message.heartbeat_ms());
  if (message.hang_s() > 0) hang_ = std::chrono::seconds(message.hang_s());
  may_drop_ = message.may_drop();
  sink_ = static_cast<proto::Deployment::Sink>(message.sink());
  hears_state_ = false;
  ready_state_.reset();  // sequences are that session's
  ready_assets_.reset();
  ready_hash_.clear();
  if (sink_ == proto::Deployment::FILES && !files_) files_.emplace(options_.out);
  restart_images(message.stream());
  gatherer_.ask_again();
  gatherer_.keep_under_way(static_cast<int>(message.stream().assets_mib()));  // pieces of one MiB
  LFD_TRY_STATUS(take_share(message.share(), *display, {message.modules().begin(), message.modules().end()}));
  follower_ = {};
  images_endpoint_.clear();  // greet it anew, wherever it is
  take_snapshot(message.snapshot());
  use_images_endpoint(message.images_endpoint());
  welcome_ = true;
  refusals_.welcomed();
  stats_.joined(static_cast<std::size_t>(message.modules_size()));
  service_.ready();
  next_words_ = Clock::now();
  log::info("joined; {} modules, state {}", message.modules_size(), follower_.sequence());
  return {};
}

Status Daemon::take_share(std::uint64_t share, const DisplayCalibration& display, std::vector<std::uint32_t> modules) {
  for (const auto k : modules) {
    if (k >= display.modules.size())
      return Error(fmt::format("the controller gives module {} of {}", k, display.modules.size()));
  }
  if (modules.size() > MODULES_PER_NODE)
    return Error(fmt::format("{} modules; a node draws at most {}", modules.size(), MODULES_PER_NODE));
  begun_.clear();
  newest_begun_.reset();
  said_ready_.clear();
  waiting_.clear();
  encoder_.give_up();
  encoded_.reset();
  states_.clear();
  share_ = share;
  ++epoch_;
  forget_prepared();
  if (drawing_ && !finishing_ && modules == modules_ && display == *display_) return {};
  retire_drawing();
  display_ = display;
  modules_ = std::move(modules);
  drawing_started_ = rehearses_ = rehearsed_ = false;
  rehearsals_ = 0;
  if (!modules_.empty()) drawing_ = std::make_unique<RenderThread>(options_.gpu, *display_, modules_);
  return {};
}

// The loop never waits for a frame under way: its thread ends by itself and is taken away once it has.
void Daemon::retire_drawing() {
  std::erase_if(retired_, [](const auto& thread) { return thread->stop_within({}); });
  forget_prepared();
  for (auto* thread : {&drawing_, &finishing_}) {
    if (*thread && !(*thread)->stop_within({})) retired_.push_back(std::move(*thread));
    thread->reset();
  }
}

bool Daemon::stop_drawing_within(Clock::duration patience) {
  const auto until = Clock::now() + patience;
  retire_drawing();
  return std::ranges::all_of(retired_, [&](const auto& thread) { return thread->stop_within(until - Clock::now()); });
}

}  // namespace lfd::node
