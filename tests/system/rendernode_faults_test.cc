// Real render nodes that are stopped or killed: frames go on without them, and they are taken back.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "base/log.h"
#include "proto/frame_files.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

// A node that is silent for 0.6 s is out.
const std::string kQuick = "sink: FILES files: \"frames\" pacing { heartbeat_ms: 100 frames_per_second: 20 }";
constexpr int kOfLeft = 1, kOfRight = 2;  // modules

class RendernodeFaults : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(draws(endpoint(), 2)); }

  const std::string& endpoint() const { return controller_.endpoint; }

  std::unique_ptr<Process> start_node(const std::string& name) const {
    return start_program("lfd-rendernode", {deployment_, "--name", name, "--controller", endpoint()});
  }

  std::uint64_t last_frame() const {
    const Result<proto::Status> status = status_at(endpoint());
    EXPECT_TRUE(status);
    return status ? status->frame() : 0;
  }

  // Whether the node that owns the module has written a picture of it for the frame or a later one.
  bool has_pictures_from(std::uint64_t frame, int module) const {
    for (const fs::directory_entry& entry : fs::directory_iterator(bench_.folder() / "frames")) {
      if (entry.path() < frame_path(bench_.folder() / "frames", frame)) continue;  // four digits: in order
      if (fs::exists(entry.path() / fmt::format("module-{:03}.color.png", module))) return true;
    }
    return false;
  }

  testing::AssertionResult writes_pictures_from(std::uint64_t frame, int module) const {
    const auto deadline = Clock::now() + kClusterPatience;
    while (!has_pictures_from(frame, module) && Clock::now() < deadline) std::this_thread::sleep_for(50ms);
    if (has_pictures_from(frame, module)) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "no picture of module " << module << " from frame " << frame << " on";
  }

  // Right's silence is noticed; then several frames are swapped and written without it.
  void expect_frames_without_right() const {
    ASSERT_TRUE(becomes(endpoint(), [](const proto::Status& status) {
      return peer_in(status, "right").state() == "out" && status.stale_modules() == 2;
    }));
    const std::uint64_t out = last_frame();
    ASSERT_TRUE(becomes(endpoint(), [out](const proto::Status& status) {
      return status.frame() >= out + 6 && status.stale_modules() == 2 && peer_in(status, "left").state() == "ready";
    }));
    EXPECT_TRUE(writes_pictures_from(out + 3, kOfLeft));
    // Two frames may have been open when it fell silent.
    EXPECT_FALSE(has_pictures_from(out + 3, kOfRight));
  }

  // All nodes follow the state, right as this process, and pictures of its modules are written again.
  void expect_right_draws(const Process& right) const {
    const auto process = static_cast<std::uint64_t>(right.id());
    ASSERT_TRUE(becomes(endpoint(), [process](const proto::Status& status) {
      return all_nodes_follow(status) && peer_in(status, "right").process() == process && status.stale_modules() == 0;
    }));
    const std::uint64_t back = last_frame();
    EXPECT_TRUE(draws(endpoint(), 3));
    EXPECT_TRUE(writes_pictures_from(back + 1, kOfRight));
    EXPECT_TRUE(writes_pictures_from(back + 1, kOfLeft));
  }

  const Workbench bench_;
  const fs::path deployment_ = bench_.deployment(kQuick);
  const RunningController controller_ = start_controller(deployment_);
  const std::unique_ptr<Process> left_ = start_node("left");
  const std::unique_ptr<Process> right_ = start_node("right");
};

TEST_F(RendernodeFaults, AStoppedNodeIsDoneWithoutAndDrawsAgainOnceItGoesOn) {
  right_->signal(SIGSTOP);
  ASSERT_NO_FATAL_FAILURE(expect_frames_without_right());
  right_->signal(SIGCONT);
  ASSERT_NO_FATAL_FAILURE(expect_right_draws(*right_));
}

TEST_F(RendernodeFaults, AKilledNodeIsDoneWithoutAndDrawsAgainOnceItIsStartedAnew) {
  right_->signal(SIGKILL);
  const auto exit = right_->wait(kClusterPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->signal, SIGKILL);
  ASSERT_NO_FATAL_FAILURE(expect_frames_without_right());
  const auto again = start_node("right");
  ASSERT_NO_FATAL_FAILURE(expect_right_draws(*again));
}

// Without any node there are no frames; nodes that come later bring them back.
TEST_F(RendernodeFaults, FramesGoOnAfterAllNodesWereKilled) {
  left_->signal(SIGKILL);
  right_->signal(SIGKILL);
  ASSERT_TRUE(left_->wait(kClusterPatience) && right_->wait(kClusterPatience));
  ASSERT_TRUE(becomes(endpoint(), [](const proto::Status& status) {
    return peer_in(status, "left").state() == "out" && peer_in(status, "right").state() == "out";
  }));
  const auto right = start_node("right"), left = start_node("left");
  ASSERT_NO_FATAL_FAILURE(expect_right_draws(*right));
}

}  // namespace
}  // namespace lfd::harness
