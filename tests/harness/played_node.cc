// The node's side of the protocol, as plainly as possible.
#include "tests/harness/played_node.h"

#include <algorithm>

#include "base/check.h"
#include "base/hash.h"
#include "proto/state.h"
#include "proto/wire/poll.h"

namespace lfd::harness {
namespace {

constexpr auto kBeat = std::chrono::milliseconds(50);

template <class T>
T opened(Result<T> opening) {
  LFD_CHECK(opening, opening.error().message());
  return *std::move(opening);
}

}  // namespace

PlayedNode::PlayedNode(std::string name, const std::string& endpoint, Habits h)
    : habits(std::move(h)),
      name_(std::move(name)),
      context_(opened(wire::open_context(habits.key_file))),
      control_(opened(wire::connect_dealer(*context_, endpoint))) {}

void PlayedNode::send(const proto::Envelope& envelope) {
  [[maybe_unused]] const Status sent = control_.send(envelope);  // a controller that is away is met again later
}

void PlayedNode::join_or_beat() {
  if (Clock::now() < next_words_ || refusal) return;
  next_words_ = Clock::now() + kBeat;
  proto::Envelope words;
  if (!welcome) {
    proto::Join& join = *words.mutable_join();
    join.set_role(habits.role);
    join.set_name(name_);
    join.set_version(habits.version);
    join.set_calibration_hash(habits.calibration_hash);
    join.set_images_endpoint(habits.images_endpoint);
    join.set_process(habits.process);
    send(words);
  } else if (habits.beats) {
    words.mutable_heartbeat()->set_state_hash(hears_state_ ? state_hash() : "");
    words.mutable_heartbeat()->set_share(share_);
    send(words);
  }
}

void PlayedNode::step() {
  join_or_beat();
  while (const auto message = control_.receive()) take_control(message->envelope);
  while (state_socket_) {
    const auto message = state_socket_->receive();
    if (!message) break;
    take_state(message->envelope);
  }
  while (bulk_) {
    const auto message = bulk_->receive();
    if (!message) break;
    take_chunk(*message);
  }
  if (bulk_ && !wanted_) want_next_asset();
}

void PlayedNode::take_control(const proto::Envelope& envelope) {
  if (envelope.has_refused() && envelope.refused().try_again_ms() == 0) refusal = envelope.refused().reason();
  if (envelope.has_snapshot()) take_snapshot(envelope.snapshot());
  if (envelope.has_prepare()) {
    prepare = envelope.prepare();
    if (habits.prepares && prepare->has_update()) say_prepared("");
  }
  if (envelope.has_assign()) {
    share_ = envelope.assign().share();
    assigned.assign(envelope.assign().modules().begin(), envelope.assign().modules().end());
  }
  if (!envelope.has_welcome() || welcome) return;
  welcome = envelope.welcome();
  share_ = welcome->share();
  state_socket_ = opened(wire::connect_subscriber(*context_, welcome->state_endpoint()));
  bulk_ = opened(wire::connect_dealer(*context_, welcome->bulk_endpoint(), wire::kChunks));
  take_snapshot(welcome->snapshot());
}

void PlayedNode::take_snapshot(const proto::Snapshot& snapshot) { state = snapshot.state(); }

void PlayedNode::take_state(const proto::Envelope& envelope) {
  proto::Envelope ask;
  ask.mutable_snapshot_request();
  if (envelope.has_quit()) quit = true;
  if (envelope.has_update() && envelope.update().sequence() > state.sequence()) {
    if (!apply_update(state, envelope.update())) send(ask);
  }
  if (envelope.has_pulse()) {
    hears_state_ = true;
    if (envelope.pulse().sequence() > state.sequence()) send(ask);
  }
  if (envelope.has_begin()) {
    if (!envelope.begin().again()) begun.push_back(envelope.begin().frame());
    const bool is_named = std::ranges::find(envelope.begin().node(), name_) != envelope.begin().node().end();
    if (is_named) named.push_back(envelope.begin().frame());
    if (is_named && habits.draws) answer(envelope.begin().frame());
  }
  if (!envelope.has_swap()) return;
  swaps.push_back(envelope.swap());
  if (!habits.shows && !habits.drops) return;
  proto::Envelope shown;
  shown.mutable_shown()->set_frame(envelope.swap().frame());
  shown.mutable_shown()->set_dropped(habits.drops);
  send(shown);
}

void PlayedNode::answer(std::uint64_t frame) {
  proto::Envelope drawn;
  drawn.mutable_drawn()->set_frame(frame);
  send(drawn);
  proto::Envelope ready;
  ready.mutable_ready()->set_frame(frame);
  ready.mutable_ready()->mutable_report()->set_node(name_);
  ready.mutable_ready()->mutable_report()->set_state_hash(habits.drawn_hash.empty() ? state_hash() : habits.drawn_hash);
  ready.mutable_ready()->mutable_report()->set_error(habits.error);
  ready.mutable_ready()->mutable_report()->set_renderer(std::string(habits.report_bytes, 'x'));
  send(ready);
}

void PlayedNode::say_prepared(const std::string& error) {
  proto::Envelope prepared;
  prepared.mutable_prepared()->set_number(prepare->number());
  prepared.mutable_prepared()->set_error(error);
  send(prepared);
}

void PlayedNode::want_next_asset() {
  for (const proto::Instance& instance : state.scene().instance()) {
    if (assets.contains(instance.mesh())) continue;
    wanted_ = instance.mesh();
    proto::Envelope want;
    want.mutable_want()->set_hash(*wanted_);
    want.mutable_want()->set_offset(partial_[*wanted_].size());
    want.mutable_want()->set_length(wire::kChunk_bytes);
    if (!bulk_->send(want)) wanted_.reset();  // the connection is still being made
    return;
  }
}

void PlayedNode::take_chunk(const wire::Message& message) {
  wanted_.reset();
  if (!message.envelope.has_chunk()) return;
  const proto::Chunk& chunk = message.envelope.chunk();
  std::string& bytes = partial_[chunk.hash()];
  bytes.append(message.payload.text());
  if (bytes.size() < chunk.total()) return;
  LFD_CHECK(content_hash(bytes) == chunk.hash(), "the asset is what was asked for");
  assets[chunk.hash()] = std::move(bytes);
}

std::string PlayedNode::state_hash() const {
  if (!state.has_scene()) return "";
  for (const proto::Instance& instance : state.scene().instance()) {
    if (!assets.contains(instance.mesh())) return "";
  }
  return lfd::state_hash(state);
}

void PlayedNode::leave() {
  proto::Envelope leave;
  leave.mutable_leave()->set_reason("the play is over");
  send(leave);
  habits.beats = false;
}

std::vector<const wire::Socket*> PlayedNode::sockets() const {
  std::vector<const wire::Socket*> all{&control_};
  if (state_socket_) all.push_back(&*state_socket_);
  if (bulk_) all.push_back(&*bulk_);
  return all;
}

bool play_until(std::initializer_list<PlayedNode*> nodes, const std::function<bool()>& done, Clock::duration at_most) {
  const auto deadline = Clock::now() + at_most;
  while (true) {
    std::vector<const wire::Socket*> sockets;
    for (PlayedNode* node : nodes) {
      node->step();
      const auto own = node->sockets();
      sockets.insert(sockets.end(), own.begin(), own.end());
    }
    if (done()) return true;
    if (Clock::now() >= deadline) return false;
    wire::wait(sockets, {}, kBeat / 2);
  }
}

}  // namespace lfd::harness
