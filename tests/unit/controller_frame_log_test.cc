// The frame log: what a report says, and what is forgotten.
#include "controller/frame_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lfd::controller {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

const Clock::time_point kStart{};

RegionOfInterest doubled() {
  RegionOfInterest roi;
  roi.world_centre = {1, 2, 3};
  roi.world_size = {1, 2, 2};
  roi.physical_size = {2, 4, 4};
  return roi;
}

TEST(FrameLog, ReportsTheMatrixRowByRow) {
  EXPECT_THAT(matrix_rows(physical_from_world(doubled())),
              ElementsAre(2, 0, 0, -2, 0, 2, 0, -4, 0, 0, 2, -6, 0, 0, 0, 1));
}

TEST(FrameLog, ReportsOneFrame) {
  FrameLog log;
  log.begun(0, doubled(), "h", kStart);
  proto::NodeReport node;
  node.set_node("left");
  log.reported(0, "left", node);
  log.swapped({.frame = 0, .ready = {"left"}, .missing = {"right"}, .late = true, .begun = kStart}, {4, 5},
              kStart + 20ms);
  EXPECT_FALSE(log.all_shown(0, 1));
  log.shown(0, kStart + 30ms);
  EXPECT_TRUE(log.all_shown(0, 1));
  EXPECT_FALSE(log.all_shown(0, 2));
  const auto reports = log.reports(0, 5);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].state_hash(), "h");
  EXPECT_EQ(reports[0].roi_diagonal(), 3);
  EXPECT_EQ(reports[0].position_origin().x(), 0);
  EXPECT_THAT(reports[0].stale_module(), ElementsAre(4, 5));
  EXPECT_EQ(reports[0].begin_to_swap_ms(), 20);
  EXPECT_EQ(reports[0].begin_to_shown_ms(), 30);
  EXPECT_EQ(reports[0].node(0).node(), "left");
  EXPECT_EQ(log.late_frames(), 1u);
}

TEST(FrameLog, MeasuresPositionsFromAFarRegionsCentre) {
  RegionOfInterest far = doubled();
  far.world_centre = {301, 0, 0};
  FrameLog log;
  log.begun(0, far, "h", kStart);
  EXPECT_EQ(log.reports(0, 1)[0].position_origin().x(), 301);
}

TEST(FrameLog, ForgetsTheOldest) {
  FrameLog log;
  log.remember(FrameLog::kRemembered);
  for (std::uint64_t frame = 0; frame < FrameLog::kRemembered + 10; ++frame) log.begun(frame, doubled(), "h", kStart);
  ASSERT_EQ(log.reports(0, 11).size(), 1u);
  EXPECT_EQ(log.reports(0, 11)[0].frame(), 10u);
  log.reported(3, "left", {});
}

TEST(FrameLog, ANodeReportsAFrameOnce) {
  FrameLog log;
  log.begun(0, doubled(), "h", kStart);
  proto::NodeReport report;
  report.set_node("somebody else");
  for (const char* const renderer : {"first", "second"}) {
    report.set_renderer(renderer);
    log.reported(0, "left", report);
  }
  const proto::FrameReport frame = log.reports(0, 1).at(0);
  ASSERT_EQ(frame.node_size(), 1);
  EXPECT_EQ(frame.node(0).node(), "left") << "as the controller knows it";
  EXPECT_EQ(frame.node(0).renderer(), "first");
}

TEST(FrameLog, LargeReportsCostTheOldestOnes) {
  FrameLog log;
  proto::NodeReport large;
  large.set_renderer(std::string(FrameLog::kMostReport_bytes / 4, 'x'));
  for (std::uint64_t frame = 0; frame < 5; ++frame) {
    log.begun(frame, doubled(), "h", kStart);
    log.reported(frame, "left", large);
  }
  std::vector<int> nodes;
  for (const proto::FrameReport& report : log.reports(0, 5)) nodes.push_back(report.node_size());
  EXPECT_EQ(nodes, (std::vector<int>{0, 0, 1, 1, 1}));
}

TEST(FrameLog, TellsTheRateOfTheLastSeconds) {
  FrameLog log;
  EXPECT_EQ(log.frames_per_second(kStart), 0);
  for (std::uint64_t frame = 0; frame < 500; ++frame) {
    log.begun(frame, doubled(), "h", kStart + frame * 10ms);
    log.swapped({.frame = frame, .ready = {}, .missing = {}, .late = false, .begun = {}}, {}, kStart + frame * 10ms);
  }
  EXPECT_NEAR(log.frames_per_second(kStart + 5s), 100, 1e-6);
  EXPECT_EQ(log.frames_per_second(kStart + 1h), 0);
}

TEST(FrameLog, RemembersFewFramesUnlessTheyAreWanted) {
  FrameLog log;
  for (std::uint64_t frame = 0; frame < 1000; ++frame) log.begun(frame, doubled(), "h", kStart);
  EXPECT_EQ(log.reports(0, 1000).size(), FrameLog::kUsuallyRemembered);
  log.remember(500);
  for (std::uint64_t frame = 1000; frame < 1500; ++frame) log.begun(frame, doubled(), "h", kStart);
  EXPECT_EQ(log.reports(1000, 500).size(), 500U);
  log.nobody_wants_them();
  EXPECT_EQ(log.reports(0, 1500).size(), FrameLog::kUsuallyRemembered);
  EXPECT_EQ(log.reports(1499, 1).size(), 1U);
}

TEST(FrameLog, TwoFramesAtTheSameMomentHaveNoRate) {
  FrameLog log;
  for (std::uint64_t frame = 0; frame < 2; ++frame) {
    log.begun(frame, doubled(), "h", kStart);
    log.swapped({.frame = frame, .ready = {}, .missing = {}, .late = false, .begun = {}}, {}, kStart);
  }
  EXPECT_EQ(log.frames_per_second(kStart), 0);
}

TEST(FrameLog, KnowsTheStateOfAFrameAndWhetherItWasShown) {
  FrameLog log;
  log.begun(3, doubled(), "h", kStart);
  ASSERT_NE(log.state_hash(3), nullptr);
  EXPECT_EQ(*log.state_hash(3), "h");
  EXPECT_EQ(log.state_hash(2), nullptr);
  EXPECT_TRUE(log.shown(3, kStart + 1ms));
  EXPECT_FALSE(log.shown(3, kStart + 9ms)) << "it was said again";
  EXPECT_TRUE(log.reported(3, "left", {}));
  EXPECT_TRUE(log.reported(3, "right", {}));
  EXPECT_FALSE(log.reported(3, "left", {})) << "likewise";
  EXPECT_EQ(log.reports(3, 1)[0].begin_to_shown_ms(), 1);
}

}  // namespace
}  // namespace lfd::controller
