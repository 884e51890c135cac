// lfd-rendernode as a process: started in any order, stopped while it draws, with a sink of its own.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>

#include "base/file.h"
#include "tests/harness/workbench.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr auto kPatience = 60s;  // a software rasteriser starts slowly on a busy machine

std::unique_ptr<Process> start_node(const fs::path& deployment, const std::string& name,
                                    const std::string& controller) {
  return start_program("lfd-rendernode", {deployment, "--name", name, "--controller", controller});
}

// Waits until a file is there.
bool appears(const fs::path& path, Process& process) {
  const auto deadline = Clock::now() + kPatience;
  while (!fs::exists(path) && Clock::now() < deadline && !process.wait(50ms)) {
  }
  return fs::exists(path);
}

TEST(RendernodeProcess, WritesItsOwnFilesAndALateNodeTakesPart) {
  const Workbench bench;
  const auto deployment =
      bench.deployment("sink: FILES files: \"frames\" pacing { heartbeat_ms: 100 frames_per_second: 5 }");
  const RunningController controller = start_controller(deployment);
  const auto left = start_node(deployment, "left", controller.endpoint);
  ASSERT_TRUE(appears(bench.folder() / "frames/frame-0001/module-001.color.png", *left));
  const auto right = start_node(deployment, "right", controller.endpoint);
  // Module 2 belongs to the late node.
  const auto deadline = Clock::now() + kPatience;
  fs::path found;
  while (found.empty() && Clock::now() < deadline && !right->wait(50ms)) {
    for (const auto& frame : fs::directory_iterator(bench.folder() / "frames")) {
      const auto path = frame.path() / "module-002.color.png";
      if (fs::exists(path)) found = path;
    }
  }
  ASSERT_FALSE(found.empty());
  controller.process->signal(SIGTERM);
  ASSERT_TRUE(controller.process->wait(2s));
  EXPECT_TRUE(left->wait(2s));
  EXPECT_TRUE(right->wait(2s));
  const auto picture = read_file(found);
  ASSERT_TRUE(picture);
  EXPECT_TRUE(picture->starts_with("\x89PNG"));
}

TEST(RendernodeProcess, StartsBeforeItsController) {
  const Workbench bench;
  const std::string endpoint = "tcp://127.0.0.1:" + std::to_string(free_port());
  const auto deployment = bench.deployment("sink: NONE addresses { control: \"" + endpoint + "\" }");
  const auto left = start_program("lfd-rendernode", {deployment, "--name", "left"});
  ASSERT_TRUE(left->wait_for_line("controller at", kPatience));
  const RunningController controller = start_controller(deployment);
  EXPECT_TRUE(left->wait_for_line("joined", kPatience));
}

TEST(RendernodeProcess, EndsWithinTwoSecondsEvenWhileAFrameIsDrawn) {
  // 8 radii of 256 samples over two million pixels: seconds of drawing on a software rasteriser.
  const Workbench bench(ImageSize{2048, 1024});
  const auto deployment = bench.deployment("sink: NONE render { ao { samples: 256 radii: 8 } }");
  const RunningController controller = start_controller(deployment);
  const auto left = start_node(deployment, "left", controller.endpoint);
  const auto right = start_node(deployment, "right", controller.endpoint);
  ASSERT_TRUE(says(*controller.process, "frame 0: begin"));
  ASSERT_FALSE(left->wait(1s));
  if (lines_with(*left, "llvmpipe") == 0) GTEST_SKIP() << "a GPU is done with the frame too soon";
  ASSERT_EQ(lines_with(*controller.process, "frame 0: swap"), 0) << "the frame is done before the signal comes";
  left->signal(SIGTERM);
  const auto exit = left->wait(2s);
  ASSERT_TRUE(exit);
  EXPECT_TRUE(exit->succeeded()) << exit->text();
  right->signal(SIGINT);  // it draws the same frame still, or the next one
  const auto other = right->wait(2s);
  ASSERT_TRUE(other);
  EXPECT_TRUE(other->succeeded()) << other->text();
}

TEST(RendernodeProcess, WrongUseAndRefusalsHaveReasons) {
  const Workbench bench;
  const auto deployment = bench.deployment("sink: NONE");
  const auto nameless = start_program("lfd-rendernode", {deployment});
  ASSERT_TRUE(nameless->wait(kPatience));
  EXPECT_EQ(nameless->wait(0s)->code, 2);
  const RunningController controller = start_controller(deployment);
  const auto unknown = start_node(deployment, "middle", controller.endpoint);
  const auto exit = unknown->wait(kPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 2);
  EXPECT_TRUE(unknown->wait_for_line("it has no node \"middle\"", 1s));
}

}  // namespace
}  // namespace lfd::harness
