// Peers choose how a controller's socket calls them: another member may take the name of a connection that is gone, but
// the key says who speaks.
#include <gtest/gtest.h>

#include <functional>
#include <thread>
#include <zmq.hpp>

#include "base/log.h"
#include "base/version.h"
#include "tests/support/unwrapped.h"
#include "tests/system/cluster_keys.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing_support::unwrapped;

std::string text_of(proto::Envelope envelope) {
  envelope.set_protocol(kProtocolVersion);
  return envelope.SerializeAsString();
}

proto::Envelope join_of_left() {
  proto::Envelope envelope;
  envelope.mutable_join()->set_name("left");
  envelope.mutable_join()->set_version(kVersion);
  envelope.mutable_join()->set_calibration_hash(Workbench::display_hash());
  envelope.mutable_join()->set_process(7);
  return envelope;
}

proto::Envelope heartbeat() {
  proto::Envelope envelope;
  envelope.mutable_heartbeat();
  return envelope;
}

class BorrowedAddress : public testing::Test {
 protected:
  // A connection with this member's key that calls itself as all here do. Where that name is taken nothing that it says
  // is heard.
  zmq::socket_t connection(const std::string& member) {
    namespace option = zmq::sockopt;
    const KeyRing keys = unwrapped(read_key_ring(keyed_.key(member)));
    zmq::socket_t socket(context_, zmq::socket_type::dealer);
    socket.set(option::linger, 0);
    socket.set(option::routing_id, "seat 1");
    socket.set(option::curve_publickey, keys.own.public_key());
    socket.set(option::curve_secretkey, keys.own.secret_key());
    socket.set(option::curve_serverkey, keys.allowed.with_right(proto::Allowed::CONTROLLER)->public_key);
    socket.connect(controller_.endpoint);
    return socket;
  }

  // Says it on ever new connections, for a second each, until `done`.
  testing::AssertionResult says_until(const std::string& member, const proto::Envelope& words,
                                      const std::function<bool()>& done) {
    for (const auto until = Clock::now() + kClusterPatience; Clock::now() < until;) {
      zmq::socket_t socket = connection(member);
      socket.send(zmq::buffer(text_of(words)), zmq::send_flags::none);
      for (int i = 0; i < 50; ++i, std::this_thread::sleep_for(20ms)) {
        if (done()) return testing::AssertionSuccess();
      }
    }
    return testing::AssertionFailure() << testing::PrintToString(controller_.process->lines());
  }
  std::function<bool()> is_said(const std::string& line) const {
    return [this, line] { return lines_with(*controller_.process, line) > 0; };
  }
  std::uint64_t refused() const {
    return unwrapped(status_at({controller_.endpoint, keyed_.key("ann")})).refused_messages();
  }

  const Workbench bench_;
  const KeyedDeployment keyed_{bench_, "sink: NONE pacing { heartbeat_ms: 500 }"};
  const RunningController controller_ = start_controller(keyed_.file);
  zmq::context_t context_;
};

TEST_F(BorrowedAddress, SpeaksForNobodyElse) {
  ASSERT_TRUE(says_until("left", join_of_left(), is_said("\"left\" joins")));  // and is gone without a word
  proto::Envelope leave;
  leave.mutable_leave()->set_reason("it never said so");
  ASSERT_TRUE(says_until(
      "guest", leave, is_said("a message from the address of \"left\" is refused: it came with the key of \"guest\"")));
  EXPECT_EQ(lines_with(*controller_.process, "it never said so"), 0);
  // Once it is out for its silence, a word from there would take it back.
  ASSERT_TRUE(says(*controller_.process, "\"left\" is out: it was silent for too long"));
  const std::uint64_t before = refused();
  EXPECT_GE(before, 1U);
  ASSERT_TRUE(says_until("guest", heartbeat(), [&] { return refused() > before; }));
  EXPECT_EQ(lines_with(*controller_.process, "is heard again"), 0);
  EXPECT_TRUE(says_until("left", heartbeat(), is_said("\"left\" is heard again")));
}

}  // namespace
}  // namespace lfd::harness
