// lfd render --time-modules: report.json tells each pass of each module by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/file.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Key;
using testing::Pair;
using testing::UnorderedElementsAre;

constexpr auto kPatience = 60s;  // a software rasteriser starts slowly on a busy machine

// The report of two frames by the nodes left (modules 0 and 1) and right (2 and 3).
nlohmann::json report_with(const std::vector<std::string>& more) {
  const Workbench bench;
  const auto out = bench.folder() / "out";
  std::vector<std::string> arguments{
      "render", bench.deployment("pacing { heartbeat_ms: 100 }"), "--frames", "2", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const auto lfd = start_program("lfd", arguments);
  const auto exit = lfd->wait(kPatience);
  EXPECT_TRUE(exit && exit->succeeded()) << testing::PrintToString(lfd->lines());
  const auto text = read_file(out / "report.json");
  return nlohmann::json::parse(text ? *text : R"({"frames": []})");
}

bool is_left(const nlohmann::json& node) { return node.at("node").get<std::string>() == "left"; }

// The modules that each pass of a node's report names, in the order of their entries.
std::map<std::string, std::vector<int>> modules_by_pass(const nlohmann::json& node) {
  std::map<std::string, std::vector<int>> modules;
  for (const auto& pass : node.at("passes")) {
    if (!pass.contains("modules")) continue;
    for (const auto& module : pass.at("modules"))
      modules[pass.at("pass").get<std::string>()].push_back(module.get<int>());
  }
  return modules;
}

// Both nodes' reports of both frames; fewer are a failure of the test.
std::vector<nlohmann::json> node_reports(const nlohmann::json& report) {
  std::vector<nlohmann::json> nodes;
  EXPECT_EQ(report.at("frames").size(), 2u);
  for (const auto& frame : report.at("frames")) {
    EXPECT_EQ(frame.at("nodes").size(), 2u);
    nodes.insert(nodes.end(), frame.at("nodes").begin(), frame.at("nodes").end());
  }
  return nodes;
}

double gpu_ms(const nlohmann::json& node) {
  double sum = 0;
  for (const auto& pass : node.at("passes")) {
    if (pass.contains("modules")) sum += pass.at("gpu_ms").get<double>();
  }
  return sum;
}

TEST(LfdRenderTimes, NameEachModuleOnceInEachPass) {
  for (const auto& node : node_reports(report_with({"--time-modules", "--plan", "everything"}))) {
    const auto modules = modules_by_pass(node);
    EXPECT_THAT(modules, UnorderedElementsAre(Key("z_prepass"), Key("gbuffer"), Key("ao"), Key("blur_horizontal"),
                                              Key("blur_vertical"), Key("post")));
    const int first = is_left(node) ? 0 : 2;
    EXPECT_THAT(modules, Each(Pair(testing::_, ElementsAre(first, first + 1))));
    EXPECT_GT(gpu_ms(node), 0) << "times that nobody took are 0";
  }
}

TEST(LfdRenderTimes, NameDrawnModulesAlone) {
  for (const auto& node : node_reports(report_with({"--time-modules", "--module", "1-2"}))) {
    const auto modules = modules_by_pass(node);
    EXPECT_THAT(modules, testing::Contains(Key("gbuffer")));
    EXPECT_THAT(modules, Each(Pair(testing::_, ElementsAre(is_left(node) ? 1 : 2))));
  }
}

TEST(LfdRenderTimes, NameNoModulesUnlessAsked) {
  for (const auto& node : node_reports(report_with({"--plan", "everything"}))) {
    EXPECT_GT(node.at("passes").size(), 6u);  // they are reported for all modules at once
    EXPECT_THAT(modules_by_pass(node), IsEmpty());
  }
}

}  // namespace
}  // namespace lfd::harness
