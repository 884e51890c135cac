// A render node under a controller that the test plays: where news were lost, it asks for a snapshot and follows that.
#include <gtest/gtest.h>

#include "proto/calibration_file.h"
#include "proto/state.h"
#include "proto/wire/poll.h"
#include "proto/wire/socket.h"
#include "tests/support/unwrapped.h"
#include "tests/system/running_cluster.h"

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

TEST(RendernodeState, AsksForASnapshotWhereUpdatesWereLost) {
  const Workbench bench;
  wire::Context context;
  wire::Socket control = unwrapped(wire::bind_router(context, "tcp://127.0.0.1:*"));
  wire::Socket state = unwrapped(wire::bind_publisher(context, "tcp://127.0.0.1:*"));
  const wire::Socket bulk = unwrapped(wire::bind_router(context, "tcp://127.0.0.1:*", wire::kChunks));
  const auto node = start_program(
      "lfd-rendernode", {bench.deployment("sink: NONE"), "--name", "left", "--controller", control.endpoint()});
  // Tells of update 3 all the while, so that the node never takes the controller for silent.
  const auto heard = [&](auto wanted) -> std::optional<wire::Message> {
    proto::Envelope pulse;
    pulse.mutable_pulse()->set_sequence(3);
    const auto until = Clock::now() + kClusterPatience;
    while (Clock::now() < until) {
      EXPECT_TRUE(state.send(pulse));
      wire::wait({&control}, {}, 50ms);
      while (auto message = control.receive()) {
        if (wanted(message->envelope)) return message;
      }
    }
    return std::nullopt;
  };
  const auto join = heard([](const auto& e) { return e.has_join(); });
  ASSERT_TRUE(join);
  proto::Envelope words;
  auto& welcome = *words.mutable_welcome();
  welcome.set_state_endpoint(state.endpoint());
  welcome.set_bulk_endpoint(bulk.endpoint());
  welcome.set_heartbeat_ms(100);
  *welcome.mutable_display() = write_calibration(unwrapped(load_calibration(bench.folder() / "display.textproto")));
  *welcome.mutable_snapshot()->mutable_state() = state_at(1, 0);  // no modules: nothing is drawn
  ASSERT_TRUE(control.send_to(join->peer, words));
  ASSERT_TRUE(heard([](const auto& e) { return e.has_snapshot_request(); }));
  proto::Envelope answer;
  *answer.mutable_snapshot()->mutable_state() = state_at(3, 6);
  ASSERT_TRUE(control.send_to(join->peer, answer));
  const std::string hash = state_hash(state_at(3, 6));
  EXPECT_TRUE(heard([&](const auto& e) { return e.has_heartbeat() && e.heartbeat().state_hash() == hash; }));
}

}  // namespace
}  // namespace lfd::harness
