// Opening, the loop, and the way of messages.
#include "controller/daemon/daemon.h"

#include <algorithm>
#include <random>

#include "base/log.h"
#include "base/version.h"
#include "controller/daemon/asset_server.h"
#include "proto/calibration_file.h"
#include "proto/module_ranges.h"
#include "proto/wire/poll.h"

namespace lfd::controller {
namespace {

constexpr int kHeartbeatsOfPatience = 6;
// How long messages of one socket are taken in before the other one, heartbeats and frames have their turn: whoever
// sends without end delays them by no more than this, and the longest answer.
constexpr auto kIntake = std::chrono::milliseconds(10);
constexpr auto kLastWords = std::chrono::seconds(1);

Membership::Rules rules_of(const Deployment& deployment) {
  Membership::Rules rules{.version = kVersion,
                          .calibration_hash = calibration_hash(deployment.display),
                          .nodes = {},
                          .patience = kHeartbeatsOfPatience * deployment.pacing.heartbeat,
                          .heartbeat = deployment.pacing.heartbeat};
  for (const NodeShare& node : deployment.nodes) rules.nodes.push_back(node.name);
  return rules;
}

Shares shares_of(const Deployment& deployment, const Assignment& assignment) {
  std::vector<std::string> spares;
  for (const NodeShare& node : deployment.nodes) {
    if (node.spare) spares.push_back(node.name);
  }
  return Shares(assignment, std::move(spares), deployment.message.give_back());
}

void take_in(wire::Socket& socket, const std::function<bool(const std::string&)>& is_known,
             const std::function<void(const wire::Message&)>& take) {
  const auto end = Clock::now() + kIntake;
  while (Clock::now() < end) {
    const auto message = socket.receive(is_known);
    if (!message) return;
    take(*message);
  }
}

// Not zero, and hardly ever that of another life.
std::uint64_t new_session() {
  std::random_device random;
  return (std::uint64_t{random()} << 32 | random()) | 1;
}

}  // namespace

Result<std::unique_ptr<Daemon>> Daemon::open(Options options) {
  LFD_TRY(Assignment assignment, assign_modules(options.deployment, options.only_modules));
  if (const std::vector<int> unowned = unowned_modules(options.deployment); !unowned.empty())
    log::warn("modules {} stay dark: no node of the deployment draws them", module_ranges(unowned));
  LFD_TRY(Stage stage, Stage::of(options.deployment));
  const bool whole_replay = options.replay && options.replay->waits_for_every_node();
  if (options.idle || whole_replay) options.deployment.pacing.deadline = {};  // who asks for frames gets whole ones
  LFD_TRY(auto context, wire::open_context(options.key_file));
  LFD_TRY(Links links, Links::open(*context, options.deployment.addresses));
  return std::unique_ptr<Daemon>(
      new Daemon(std::move(options), std::move(links), std::move(context), std::move(stage), std::move(assignment)));
}

Daemon::Daemon(Options options, Links links, std::unique_ptr<wire::Context> context, Stage stage, Assignment assignment)
    : options_(std::move(options)),
      context_(std::move(context)),
      links_(std::move(links)),
      stage_(std::move(stage)),
      session_(new_session()),
      assignment_(std::move(assignment)),
      shares_(shares_of(options_.deployment, assignment_)),
      members_(rules_of(options_.deployment)),
      barrier_(options_.deployment.pacing.deadline),
      pacing_(options_.deployment.pacing.frames_per_second, options_.idle) {}

Status Daemon::start_show() {
  if (options_.replay) return start_replay();
  const Deployment& deployment = options_.deployment;
  if (deployment.scene_file) {
    loader_.start(*deployment.scene_file, {}, 0);
  } else {
    loader_.start(deployment.message.scene().made(), {}, 0);
  }
  return {};
}

Status Daemon::run(StopSignals& signals) {
  Status first_scene = start_show();
  next_pulse_ = Clock::now();
  while (!end_) {
    wire::wait({&links_.control, &links_.bulk}, {signals.descriptor(), loader_.descriptor()}, wake_at() - Clock::now());
    const Clock::time_point now = Clock::now();
    const auto is_member = [&](const std::string& peer) { return members_.at(peer) != nullptr; };
    take_in(links_.control, is_member, [&](const wire::Message& message) { take_control(message, now); });
    take_in(links_.bulk, {}, [&](const wire::Message& message) { take_want(message, now); });
    if (auto arrival = loader_.take()) first_scene = take_scene(*std::move(arrival), now);
    settle_scene(now);
    if (!first_scene) end_ = "there is no scene to show";
    if (const auto signal = signals.take()) end_ = fmt::format("signal {}", *signal);
    tick(now);
  }
  service_.stopping();
  log::info("ends: {}", *end_);
  proto::Envelope quit;
  quit.mutable_quit()->set_reason(*end_);
  publish(quit);
  for (const Peer* peer : members_.peers()) {
    if (peer->lives() && !peer->last_heard) send(peer->address, quit);  // it does not hear the state channel yet
  }
  links_.state.linger(kLastWords);
  links_.control.linger(kLastWords);
  return first_scene ? replay_failed_ : first_scene;
}

void Daemon::take_control(const wire::Message& message, Clock::time_point now) {
  if (borrows_address(message, now)) return;
  const proto::Envelope& envelope = message.envelope;
  const Membership::Heard heard = members_.heard(message.peer, now);
  const Peer* peer = members_.at(message.peer);
  if (heard == Membership::Heard::kBack) peer_is_back(*peer);
  switch (envelope.body_case()) {
    case proto::Envelope::kJoin:
      return take_join(message, now);
    case proto::Envelope::kRequest:
      return take_request(message, now);
    case proto::Envelope::kHeartbeat:
      return take_heartbeat(message);
    case proto::Envelope::kSnapshotRequest:
      if (peer != nullptr && stage_.has_scene() && limiter_.admits(message.peer, now)) send_snapshot(message.peer);
      return;
    case proto::Envelope::kDrawn:
      if (peer != nullptr) barrier_.drawn(peer->name, envelope.drawn().frame());
      return;
    case proto::Envelope::kReady:
      if (peer == nullptr || peer->role != proto::NODE) return;
      return take_ready(*peer, envelope.ready(), now);
    case proto::Envelope::kPrepared:
      if (peer != nullptr) change_.prepared(peer->name, envelope.prepared().number(), envelope.prepared().error());
      return;
    case proto::Envelope::kShown:
      if (peer == nullptr || peer->role != proto::DISPLAY) return;
      return take_shown(peer->name, envelope.shown(), now);
    case proto::Envelope::kLeave:
      if (const auto name = members_.leave(message.peer)) peer_is_gone(*name, envelope.leave().reason().c_str());
      return;
    default:
      stats_.refused();
      log::debug("control: a message that nobody sends to a controller");
      return;
  }
}

void Daemon::take_want(const wire::Message& message, Clock::time_point now) {
  if (!stage_.has_scene() || !message.envelope.has_want()) return;
  const proto::Want& want = message.envelope.want();
  const AssetAnswer answer = answer_want(want, *assets_for(want.hash()));
  const Status served = links_.bulk.send_to(message.peer, answer.envelope, answer.piece);
  if (!served && unread_pieces_.due(now)) log::warn("bulk: {}", served.error().message());
}

void Daemon::tick(Clock::time_point now) {
  for (const std::string& name : members_.expire(now)) peer_is_gone(name, "it was silent for too long");
  if (now >= next_pulse_) {
    proto::Envelope pulse;
    pulse.mutable_pulse()->set_sequence(stage_.store().sequence());
    publish(pulse);
    say_again(now);
    next_pulse_ = now + options_.deployment.pacing.heartbeat;
  }
  settle_shares(now);
  advance(now);
  serve(now);
  end_replay(now);
}

Clock::time_point Daemon::wake_at() const {
  Clock::time_point wake = std::min(next_pulse_, service_.next_alive());
  if (const auto deadline = barrier_.next_deadline()) wake = std::min(wake, *deadline);
  const auto step = options_.replay ? options_.replay->due_at() : pacing_.next();
  if (step && barrier_.may_begin() && *step > Clock::now()) wake = std::min(wake, *step);
  return wake;
}

void Daemon::publish(proto::Envelope envelope) {
  envelope.set_session(session_);
  stats_.published(envelope.ByteSizeLong());
  if (const Status sent = links_.state.send(envelope); !sent) log::error("state: {}", sent.error().message());
}

void Daemon::publish(const proto::Update& update) {
  proto::Envelope envelope;
  *envelope.mutable_update() = update;
  publish(std::move(envelope));
}

void Daemon::send(const std::string& address, proto::Envelope envelope, const wire::Payload& payload) {
  envelope.set_session(session_);
  if (const Status sent = links_.control.send_to(address, envelope, payload); !sent) {
    if (members_.at(address) != nullptr) return log::warn("control: {}", sent.error().message());
    if (unread_answers_.due(Clock::now())) log::debug("control: {}", sent.error().message());  // it may not care
  }
}

}  // namespace lfd::controller
