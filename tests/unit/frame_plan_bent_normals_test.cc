// The frame planner: bent normals are found for those who read them.
#include <gtest/gtest.h>

#include <algorithm>

#include "calibration/make.h"
#include "rendernode/plan/frame_plan.h"

namespace lfd {
namespace {

// One lit item before four modules.
class BentNormalPlanning : public testing::Test {
 protected:
  BentNormalPlanning() : display_(*make_display("640rc", 4)) {
    items_[0].index_count = 3;
    items_[0].low = {-0.2, -0.2, -0.1};
    items_[0].high = {0.2, 0.2, 0.1};
    settings_.ao.bent_normals = true;
  }

  FramePlan plan() const {
    return plan_frame({&display_, &modules_, &items_, &materials_, lights_, settings_, buffers_});
  }

  std::string why() const {
    const FramePlan made = plan();
    const auto left = std::ranges::find(made.left_out, "bent normal", &proto::LeftOut::which);
    return left == made.left_out.end() ? "not left out" : left->what() + ": " + left->why();
  }

  DisplayCalibration display_;
  std::vector<std::uint32_t> modules_{0, 1, 2, 3};
  std::vector<GeometryItem> items_{1};
  std::vector<MaterialFacts> materials_{1};
  LightFacts lights_{true, false};
  RenderSettings settings_;
  BufferSet buffers_;
};

TEST_F(BentNormalPlanning, TheyAreFoundWhereALightShinesOnThem) {
  EXPECT_TRUE(plan().bent && plan().normal && plan().ao);
  EXPECT_EQ(why(), "not left out");
  settings_.ao.bent_normals = false;
  EXPECT_FALSE(plan().bent);
  EXPECT_EQ(why(), "not left out") << "nobody asked for them";
}

TEST_F(BentNormalPlanning, AmbientLightAloneDoesNotReadThem) {
  lights_ = {};
  EXPECT_FALSE(plan().bent || plan().normal);
  EXPECT_TRUE(plan().ao);
  EXPECT_EQ(why(), "target: nothing reads it");
  settings_.plan = false;
  EXPECT_TRUE(plan().bent) << "everything is drawn";
}

TEST_F(BentNormalPlanning, TheirFileNeedsThemEvenWhereNoLightShines) {
  lights_ = {};
  settings_.unlit = true;
  EXPECT_FALSE(plan().bent || plan().ao);
  buffers_.bits = 1U << proto::BENT_NORMAL;
  EXPECT_TRUE(plan().bent && plan().normal && plan().ao);
  settings_.ao.bent_normals = false;
  EXPECT_FALSE(plan().bent || plan().ao);
  EXPECT_TRUE(plan().normal) << "where all is open they are the normals";
}

TEST_F(BentNormalPlanning, PicturesWithThemDifferInTheirInputs) {
  const auto with = plan().inputs;
  settings_.ao.method = occlusion::find_method("alchemy");
  settings_.ao.parameters = occlusion::fallbacks(*settings_.ao.method);
  EXPECT_FALSE(plan().bent);
  EXPECT_EQ(why(), "target: the method has no directions");
  EXPECT_NE(plan().inputs, with);
  settings_.ao.enabled = false;
  EXPECT_EQ(why(), "not left out") << "there is no ambient occlusion at all";
}

}  // namespace
}  // namespace lfd
