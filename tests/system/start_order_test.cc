// Daemons of one cluster started in every order that matters: frames come whole and reach the display.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "base/log.h"
#include "proto/frame_files.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using Order = std::vector<std::string>;

class StartOrder : public testing::TestWithParam<Order> {};
INSTANTIATE_TEST_SUITE_P(Orders, StartOrder,
                         testing::Values(Order{"display", "left", "right", "controller"},
                                         Order{"left", "controller", "display", "right"},
                                         Order{"right", "left", "controller", "display"}),
                         [](const auto& order) { return fmt::format("{}", fmt::join(order.param, "_")); });

TEST_P(StartOrder, FramesComeWhole) {
  const Workbench bench;
  const std::string endpoint = fmt::format("tcp://127.0.0.1:{}", free_port());
  const std::string wall = bench.deployment(fmt::format(
      "sink: DISPLAY pacing {{ heartbeat_ms: 100 frames_per_second: 10 }} addresses {{ control: \"{}\" }}", endpoint));
  const auto shown = bench.folder() / "shown";
  std::map<std::string, std::unique_ptr<Process>> daemons;
  for (const std::string& name : GetParam()) {
    auto& daemon = daemons[name];
    if (name == "controller") daemon = start_program("lfd-controller", {wall});
    if (name == "display") daemon = start_program("lfd-display", {wall, "--out", shown});
    if (name == "left" || name == "right") daemon = start_program("lfd-rendernode", {wall, "--name", name});
    // It has tried to reach who is not there yet.
    const char* const said = name == "controller" ? "control" : "controller at";
    ASSERT_TRUE(daemon->wait_for_line(said, kClusterPatience)) << name;
  }
  ASSERT_TRUE(becomes(endpoint, [](const proto::Status& s) { return peer_in(s, "display").state() == "ready"; }));
  ASSERT_TRUE(draws(endpoint, 2));
  const auto status = status_at(endpoint);
  ASSERT_TRUE(status);
  const auto deadline = Clock::now() + kClusterPatience;
  const auto picture = image_path(shown, status->frame() + 2, 3, proto::COLOR);
  while (!std::filesystem::exists(picture) && Clock::now() < deadline)
    daemons["display"]->wait(std::chrono::milliseconds(50));
  EXPECT_TRUE(std::filesystem::exists(picture));
}

}  // namespace
}  // namespace lfd::harness
