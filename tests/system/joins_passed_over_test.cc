// Joins that are too many: whoever is passed over is told to try again, now and then, and comes in once there is room.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "base/log.h"
#include "base/version.h"
#include "proto/wire/poll.h"
#include "tests/support/unwrapped.h"
#include "tests/system/cluster_keys.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing_support::unwrapped;

// Joins that are refused wherever they are looked at, without end until it is destroyed; counts the answers.
class JoinFlood {
 public:
  JoinFlood(const std::string& endpoint, const std::string& key_file)
      : thread_([this, endpoint, key_file] { run(endpoint, key_file); }) {}
  ~JoinFlood() {
    ended_ = true;
    thread_.join();
  }

  int sent() const { return sent_; }
  int refused() const { return refused_; }
  int told_to_wait() const { return told_to_wait_; }

 private:
  void run(const std::string& endpoint, const std::string& key_file) {
    const auto context = unwrapped(wire::open_context(key_file));
    wire::Socket socket = unwrapped(wire::connect_dealer(*context, endpoint));
    proto::Envelope join;
    join.mutable_join()->set_name("left");
    join.mutable_join()->set_version("of long ago");
    while (!ended_) {
      if (socket.send(join)) {
        ++sent_;
      } else {
        wire::wait({&socket}, {}, 1ms);
      }
      while (const auto message = socket.receive()) {
        const proto::Refused& refused = message->envelope.refused();
        (refused.try_again_ms() > 0 ? told_to_wait_ : refused_) += message->envelope.has_refused() ? 1 : 0;
      }
    }
  }

  std::atomic<bool> ended_{false};
  std::atomic<int> sent_{0}, refused_{0}, told_to_wait_{0};
  std::thread thread_;
};

testing::AssertionResult waits_for(const std::function<bool()>& done) {
  for (const auto until = Clock::now() + kClusterPatience; Clock::now() < until; std::this_thread::sleep_for(5ms)) {
    if (done()) return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "it does not come";
}

// Somebody has got hold of the node's key: joins are counted by key, so the node itself is passed over too.
TEST(JoinsPassedOver, ANodeIsToldAndComesInLater) {
  const Workbench bench;
  const KeyedDeployment keyed(bench, "sink: NONE");
  const RunningController controller = start_controller(keyed.file);
  std::optional<JoinFlood> flood(std::in_place, controller.endpoint, keyed.key("left"));
  ASSERT_TRUE(waits_for([&] { return flood->told_to_wait() > 0; }));
  const auto node =
      start_program("lfd-rendernode", {keyed.file.string(), "--name", "left", "--controller", controller.endpoint});
  EXPECT_TRUE(says(*node, "not let in yet: too many want to join; joining again every 1000 ms"));
  EXPECT_TRUE(says(*controller.process, "too many joins and requests for the state"));
  EXPECT_EQ(lines_with(*node, "joined; "), 0);
  flood.reset();
  EXPECT_TRUE(says(*node, "joined; 2 modules"));
  EXPECT_EQ(lines_with(*node, "not let in yet"), 1);
  EXPECT_FALSE(node->poll());
}

TEST(JoinsPassedOver, AFloodIsNotAnsweredByAFlood) {
  const Workbench bench;
  const RunningController controller = start_controller(bench.deployment("sink: NONE"));
  const auto begin = Clock::now();
  const JoinFlood flood(controller.endpoint, "");
  ASSERT_TRUE(waits_for([&] { return flood.told_to_wait() >= 3; }));
  const double seconds = milliseconds(Clock::now() - begin) / 1000;
  EXPECT_GT(flood.sent(), 1000);
  EXPECT_LE(flood.told_to_wait(), seconds + 2) << "once a second, and one that came since the time was taken";
  EXPECT_LE(flood.refused(), 10 + 5 * seconds + 5) << "those that were looked at, and of one second more";
}

}  // namespace
}  // namespace lfd::harness
