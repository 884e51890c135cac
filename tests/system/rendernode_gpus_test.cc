// lfd-rendernode and GPUs: which there are, which one is wanted, which way to it was taken.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "base/log.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

// A line of --list-gpus.
struct Listed {
  int number = 0;  // -1: the surfaceless platform of a driver that lists no devices
  bool usable = false;
  std::string description;
};

// What the driver's own libraries say on standard error is passed over.
std::vector<Listed> listed_gpus() {
  static const std::regex kLine("(-?[0-9]+)  (usable  |unusable)  (.+)");
  const auto node = start_program("lfd-rendernode", {"--list-gpus"});
  const auto exit = node->wait(kClusterPatience);
  EXPECT_TRUE(exit && exit->succeeded()) << testing::PrintToString(node->lines());
  std::vector<Listed> gpus;
  for (const std::string& line : node->lines()) {
    std::smatch match;
    if (!std::regex_match(line, match, kLine)) continue;
    gpus.push_back({std::stoi(match[1].str()), match[2].str() != "unusable", match[3].str()});
  }
  return gpus;
}

std::unique_ptr<Process> start_left(const Workbench& bench, const RunningController& controller,
                                    const std::vector<std::string>& more) {
  std::vector<std::string> arguments{bench.folder() / "wall.textproto", "--name", "left", "--controller",
                                     controller.endpoint};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return start_program("lfd-rendernode", arguments);
}

TEST(RendernodeGpus, AreListedOneALine) {
  const std::vector<Listed> gpus = listed_gpus();
  ASSERT_FALSE(gpus.empty());
  EXPECT_TRUE(std::ranges::any_of(gpus, &Listed::usable));
  const int first = gpus.front().number;
  EXPECT_TRUE(first == 0 || (first == -1 && gpus.size() == 1)) << first;
  for (std::size_t i = 0; i < gpus.size(); ++i) {
    EXPECT_EQ(gpus[i].number, first + static_cast<int>(i));
    if (gpus[i].usable) {
      EXPECT_THAT(gpus[i].description, HasSubstr("OpenGL "));
    }
  }
}

TEST(RendernodeGpus, OneThatIsNotThereIsRefusedWithTheirNumber) {
  const auto count = std::ranges::count_if(listed_gpus(), [](const Listed& gpu) { return gpu.number >= 0; });
  const Workbench bench;
  const RunningController controller = start_controller(bench.deployment("sink: NONE"));
  const auto node = start_left(bench, controller, {"--gpu", "99"});
  const auto exit = node->wait(kClusterPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  const auto line = node->wait_for_line("error: ", kClusterPatience);
  ASSERT_TRUE(line);
  EXPECT_THAT(*line, HasSubstr(fmt::format("gpu 99: there are {} ", count)));
}

// One that the list calls usable is used where it is asked for.
TEST(RendernodeGpus, OneOfTheListDraws) {
  const std::vector<Listed> gpus = listed_gpus();
  const auto usable = std::ranges::find_if(gpus, [](const Listed& gpu) { return gpu.usable && gpu.number >= 0; });
  if (usable == gpus.end()) GTEST_SKIP() << "the driver lists no devices";
  const Workbench bench;
  const RunningController controller = start_controller(bench.deployment("sink: NONE"));
  const auto node = start_left(bench, controller, {"--gpu", std::to_string(usable->number)});
  const auto line = node->wait_for_line("draws 2 modules with ", kClusterPatience);
  ASSERT_TRUE(line) << testing::PrintToString(node->lines());
  EXPECT_THAT(*line, HasSubstr(usable->description));
}

// Two ways lead to a driver, and they may lead to different ones: whoever reads the log has to know which was taken.
TEST(RendernodeGpus, ThePlatformThatWasChosenIsNamed) {
  const Workbench bench;
  const RunningController controller = start_controller(bench.deployment("sink: NONE"));
  const auto node = start_left(bench, controller, {});
  const auto line = node->wait_for_line("draws 2 modules with ", kClusterPatience);
  ASSERT_TRUE(line) << testing::PrintToString(node->lines());
  EXPECT_THAT(*line, ContainsRegex("device|surfaceless"));
}

}  // namespace
}  // namespace lfd::harness
