// A render node under a controller that the test plays: where news were lost, it asks for a snapshot and follows that;
// where assets were lost, it asks for them again.
#include <gtest/gtest.h>

#include <functional>

#include "base/hash.h"
#include "proto/calibration_file.h"
#include "proto/deployment.pb.h"
#include "proto/settings.h"
#include "proto/state.h"
#include "proto/wire/poll.h"
#include "proto/wire/socket.h"
#include "tests/support/unwrapped.h"
#include "tests/system/running_cluster.h"
#include "tests/system/tcp_relay.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing_support::unwrapped;

constexpr std::uint32_t kAgain_ms = 2000;

proto::State state_at(std::uint64_t sequence, std::uint32_t buffers) {
  proto::State state;
  state.set_sequence(sequence);
  state.set_buffers(buffers);
  state.mutable_scene()->add_light();
  return state;
}

class RendernodeState : public testing::Test {
 protected:
  // Waits for the node's word. Tells of this update all the while, so that the node never takes the controller for
  // silent.
  std::optional<wire::Message> heard(std::uint64_t sequence,
                                     const std::function<bool(const proto::Envelope& envelope)>& wanted) {
    proto::Envelope pulse;
    pulse.mutable_pulse()->set_sequence(sequence);
    const auto until = Clock::now() + kClusterPatience;
    while (Clock::now() < until) {
      EXPECT_TRUE(state_.send(pulse));
      wire::wait({&control_, &bulk_}, {}, 50ms);
      while (const auto message = bulk_.receive()) answer_want_(*message);
      while (auto message = control_.receive()) {
        if (wanted(message->envelope)) return message;
      }
    }
    return std::nullopt;
  }

  // Lets the node join, with modules_: without any nothing is drawn. It is told this state, and to ask there for
  // assets.
  testing::AssertionResult welcomes(const proto::State& told, const std::string& bulk_endpoint) {
    const auto join = heard(told.sequence(), [](const auto& e) { return e.has_join(); });
    if (!join) return testing::AssertionFailure() << "it does not join";
    node_at_ = join->peer;
    proto::Envelope words;
    auto& welcome = *words.mutable_welcome();
    welcome.set_state_endpoint(state_.endpoint());
    welcome.set_bulk_endpoint(bulk_endpoint);
    welcome.set_heartbeat_ms(100);
    welcome.set_sink(proto::Deployment::NONE);
    for (const std::uint32_t module : modules_) welcome.add_modules(module);
    *welcome.mutable_display() = write_calibration(unwrapped(load_calibration(bench_.folder() / "display.textproto")));
    *welcome.mutable_snapshot()->mutable_state() = told;
    if (!control_.send_to(node_at_, words)) return testing::AssertionFailure() << "it is gone";
    return testing::AssertionSuccess();
  }

  const Workbench bench_;
  wire::Context context_;
  wire::Socket control_ = unwrapped(wire::bind_router(context_, "tcp://127.0.0.1:*"));
  wire::Socket state_ = unwrapped(wire::bind_publisher(context_, "tcp://127.0.0.1:*"));
  wire::Socket bulk_ = unwrapped(wire::bind_router(context_, "tcp://127.0.0.1:*", wire::kChunks));
  std::string node_at_;
  std::vector<std::uint32_t> modules_;
  std::function<void(const wire::Message& want)> answer_want_ = [](const wire::Message&) {};
  const std::unique_ptr<Process> node_ = start_program(
      "lfd-rendernode", {bench_.deployment("sink: NONE"), "--name", "left", "--controller", control_.endpoint()});
};

TEST_F(RendernodeState, AsksForASnapshotWhereUpdatesWereLost) {
  ASSERT_TRUE(welcomes(state_at(1, 0), bulk_.endpoint()));
  ASSERT_TRUE(heard(3, [](const auto& e) { return e.has_snapshot_request(); }));
  proto::Envelope answer;
  *answer.mutable_snapshot()->mutable_state() = state_at(3, 6);
  ASSERT_TRUE(control_.send_to(node_at_, answer));
  const std::string hash = state_hash(state_at(3, 6));
  EXPECT_TRUE(heard(3, [&](const auto& e) { return e.has_heartbeat() && e.heartbeat().state_hash() == hash; }));
}

TEST_F(RendernodeState, JoinsLaterWhereItIsToldToTryAgain) {
  proto::Envelope later;
  later.mutable_refused()->set_reason("too many want to join");
  later.mutable_refused()->set_try_again_ms(kAgain_ms);
  std::vector<Clock::time_point> joins;
  for (int i = 0; i < 3; ++i) {
    const auto join = heard(1, [](const auto& e) { return e.has_join(); });
    ASSERT_TRUE(join);
    joins.push_back(Clock::now());
    ASSERT_TRUE(control_.send_to(join->peer, later));
  }
  // Less what the first of the two was late here; joins that nobody answers come every 300 ms.
  EXPECT_GT(joins[2] - joins[1], std::chrono::milliseconds(kAgain_ms) / 2);
  ASSERT_TRUE(welcomes(state_at(1, 0), bulk_.endpoint()));
  ASSERT_TRUE(control_.send_to(node_at_, later));  // of a join before the one that let it in
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(heard(1, [](const auto& e) { return e.has_heartbeat(); }));
  EXPECT_FALSE(node_->poll());
  EXPECT_EQ(lines_with(*node_, "not let in yet: too many want to join; joining again every 2000 ms"), 1);
}

// A controller that was started anew answers every heartbeat that was on its way.
TEST_F(RendernodeState, JoinsAgainHoweverOftenItIsNotAMember) {
  ASSERT_TRUE(welcomes(state_at(1, 0), bulk_.endpoint()));
  ASSERT_TRUE(heard(1, [](const auto& e) { return e.has_heartbeat(); }));
  proto::Envelope stranger;
  stranger.mutable_refused()->set_reason("not a member of this cluster");
  stranger.mutable_refused()->set_not_a_member(true);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(control_.send_to(node_at_, stranger));
  ASSERT_TRUE(welcomes(state_at(2, 6), bulk_.endpoint()));
  const std::string hash = state_hash(state_at(2, 6));
  EXPECT_TRUE(heard(2, [&](const auto& e) { return e.has_heartbeat() && e.heartbeat().state_hash() == hash; }));
  EXPECT_FALSE(node_->poll());
}

// The connection of assets alone ends, with all requests and answers that are on their way.
TEST_F(RendernodeState, AsksAgainForAssetsWhoseConnectionBroke) {
  const auto mesh = std::make_shared<const std::string>(std::size_t{20} << 20, 'm');  // nobody reads it
  proto::State told = state_at(1, 0);
  told.mutable_scene()->add_instance()->set_mesh(content_hash(*mesh));
  TcpRelay relay(bulk_.endpoint());
  constexpr int kAnswered = 5, kUnderWay = 8;  // as AssetGatherer has it
  int wants = 0;
  answer_want_ = [&](const wire::Message& message) {
    const proto::Want& want = message.envelope.want();
    if (++wants == kAnswered + kUnderWay) relay.cut();
    if (wants > kAnswered && wants <= kAnswered + kUnderWay) return;
    proto::Envelope answer;
    answer.mutable_chunk()->set_hash(want.hash());
    answer.mutable_chunk()->set_offset(want.offset());
    answer.mutable_chunk()->set_total(mesh->size());
    const auto rest = std::as_bytes(std::span(*mesh)).subspan(want.offset());
    const wire::Payload piece(mesh, rest.first(std::min<std::size_t>(want.length(), rest.size())));
    EXPECT_TRUE(bulk_.send_to(message.peer, answer, piece));
  };
  ASSERT_TRUE(welcomes(told, relay.endpoint()));
  const std::string hash = state_hash(told);
  EXPECT_TRUE(heard(1, [&](const auto& e) { return e.has_heartbeat() && e.heartbeat().state_hash() == hash; }));
  EXPECT_EQ(relay.cuts(), 1);
  EXPECT_EQ(wants, 20 + kUnderWay) << "what had come was kept";
}

class RendernodeFrames : public RendernodeState {
 protected:
  void SetUp() override {
    modules_ = {0};
    ASSERT_TRUE(welcomes(shown(1), bulk_.endpoint()));
    ASSERT_TRUE(heard(1, [](const auto& e) { return !e.heartbeat().state_hash().empty(); })) << "it can draw";
  }

  static proto::State shown(std::uint64_t sequence, double red = 0) {
    proto::State state = state_at(sequence, 1);
    state.mutable_scene()->clear_light();
    *state.mutable_roi() = write_roi(RegionOfInterest());
    state.mutable_render()->mutable_background()->set_r(red);
    return state;
  }

  void begin(std::uint64_t frame, std::uint64_t sequence) {
    proto::Envelope envelope;
    envelope.mutable_begin()->set_frame(frame);
    envelope.mutable_begin()->set_sequence(sequence);
    envelope.mutable_begin()->add_node("left");
    ASSERT_TRUE(state_.send(envelope));
  }

  std::optional<proto::Ready> ready(std::uint64_t frame, std::uint64_t sequence) {
    const auto message = heard(sequence, [&](const auto& e) { return e.has_ready() && e.ready().frame() == frame; });
    return message ? std::optional(message->envelope.ready()) : std::nullopt;
  }
};

TEST_F(RendernodeFrames, SaysAgainThatItIsReadyWhereItIsAskedAgain) {
  begin(5, 1);
  const auto first = ready(5, 1);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->report().error(), "");
  begin(6, 1);
  ASSERT_TRUE(ready(6, 1));
  begin(5, 1);
  const auto again = ready(5, 1);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->SerializeAsString(), first->SerializeAsString()) << "it was not drawn again";
}

// Snapshots come by another channel than begins, which may be overtaken by them.
TEST_F(RendernodeFrames, DrawsNoFrameFromANewerState) {
  begin(5, 2);  // its update was lost
  ASSERT_TRUE(heard(2, [](const auto& e) { return e.has_snapshot_request(); }));
  proto::Envelope answer;
  *answer.mutable_snapshot()->mutable_state() = shown(3, 0.5);
  ASSERT_TRUE(control_.send_to(node_at_, answer));
  const auto late = ready(5, 3);
  ASSERT_TRUE(late);
  EXPECT_NE(late->report().error(), "") << "the others draw state 2";
  begin(6, 2);  // it was on its way all the while
  const auto overtaken = ready(6, 3);
  ASSERT_TRUE(overtaken);
  EXPECT_NE(overtaken->report().error(), "");
  begin(7, 3);
  const auto own = ready(7, 3);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->report().error(), "");
  EXPECT_EQ(own->report().state_hash(), state_hash(shown(3, 0.5)));
}

}  // namespace
}  // namespace lfd::harness
