// A render node under a controller that the test plays: where news were lost, it asks for a snapshot and follows that;
// where assets were lost, it asks for them again.
#include <gtest/gtest.h>

#include <functional>

#include "base/hash.h"
#include "proto/calibration_file.h"
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

  // Lets the node join, without modules: nothing is drawn. It is told this state, and to ask there for assets.
  testing::AssertionResult welcomes(const proto::State& told, const std::string& bulk_endpoint) {
    const auto join = heard(told.sequence(), [](const auto& e) { return e.has_join(); });
    if (!join) return testing::AssertionFailure() << "it does not join";
    node_at_ = join->peer;
    proto::Envelope words;
    auto& welcome = *words.mutable_welcome();
    welcome.set_state_endpoint(state_.endpoint());
    welcome.set_bulk_endpoint(bulk_endpoint);
    welcome.set_heartbeat_ms(100);
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

}  // namespace
}  // namespace lfd::harness
