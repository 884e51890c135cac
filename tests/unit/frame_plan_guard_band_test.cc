// The frame planner: when a guard band is drawn, and what is drawn into it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "calibration/guard_band.h"
#include "calibration/make.h"
#include "rendernode/plan/frame_plan.h"
#include "tests/support/unwrapped.h"

namespace lfd {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Four modules, one lit item in the middle of the screen, a band of 64 pixels.
class GuardBandPlanning : public testing::Test {
 protected:
  GuardBandPlanning() {
    settings_.ao.guard_band_px = 64;
    add_item({-0.1, -0.1, 0}, {0.1, 0.1, 0});
  }

  void add_item(Point3<Physical> low, Point3<Physical> high) {
    GeometryItem item;
    item.low = low;
    item.high = high;
    items_.push_back(item);
  }

  FramePlan plan(bool with_band = true) const {
    return plan_frame({&display_,
                       &modules_,
                       &items_,
                       &materials_,
                       {},
                       settings_,
                       buffers_,
                       {},
                       nullptr,
                       false,
                       with_band ? &banded_ : nullptr});
  }

  static std::string why(const FramePlan& plan, const std::string& what, const std::string& which) {
    for (const proto::LeftOut& left : plan.left_out) {
      if (left.what() == what && left.which() == which) return left.why();
    }
    return "not left out";
  }
  static std::string why(const FramePlan& plan) { return why(plan, "target", "guard band"); }

  DisplayCalibration display_ = testing_support::unwrapped(make_display("640rc", 4));
  DisplayCalibration banded_ = with_guard_band(display_, 64);
  std::vector<std::uint32_t> modules_{0, 1, 2, 3};
  std::vector<GeometryItem> items_;
  std::vector<MaterialFacts> materials_{MaterialFacts{}};
  RenderSettings settings_;
  BufferSet buffers_;
};

TEST_F(GuardBandPlanning, ABandIsDrawnForOcclusionThatIsRead) {
  EXPECT_EQ(plan().guard_band_px, 64);
  EXPECT_EQ(why(plan()), "not left out");
  settings_.unlit = true;
  EXPECT_EQ(plan().guard_band_px, 0);
  EXPECT_EQ(why(plan()), "nothing reads ambient occlusion");
  settings_.plan = false;
  EXPECT_TRUE(plan().ao);
  EXPECT_EQ(plan().guard_band_px, 0) << "pictures are those of the plan";
  settings_.plan = true;
  buffers_.bits = 1U << proto::AO;
  EXPECT_EQ(plan().guard_band_px, 64);
  items_.clear();
  EXPECT_EQ(plan().guard_band_px, 0);
  EXPECT_EQ(why(plan()), "no module sees geometry");
}

TEST_F(GuardBandPlanning, WithoutOcclusionThereIsNone) {
  settings_.ao.enabled = false;
  EXPECT_EQ(plan(false).guard_band_px, 0);
  EXPECT_EQ(why(plan(false)), "there is no ambient occlusion that needs it");
  settings_.ao.enabled = true;
  settings_.ao.guard_band_px = 0;
  EXPECT_EQ(why(plan(false)), "not left out") << "it was not asked for";
}

TEST_F(GuardBandPlanning, WhatLiesInTheBandIsDrawnWhereSomethingIsSeenBesideIt) {
  add_item({0.81, -0.1, 0}, {0.83, 0.1, 0});  // 10 to 22 pixels right of the screen
  EXPECT_THAT(plan().active_layers, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(plan().groups[0].draws.size(), 8U);
  EXPECT_EQ(plan(false).groups[0].draws.size(), 4U);
  const auto inputs = plan().inputs;
  items_[1].content = "moved";
  EXPECT_NE(plan().inputs, inputs) << "the pictures change with it";
  EXPECT_NE(plan(false).inputs, inputs) << "and with the band";
  items_.erase(items_.begin());
  EXPECT_THAT(plan().active_layers, IsEmpty());
  EXPECT_THAT(plan().groups, IsEmpty());
  EXPECT_EQ(why(plan(), "module", "2"), "no geometry in its view");
}

}  // namespace
}  // namespace lfd
