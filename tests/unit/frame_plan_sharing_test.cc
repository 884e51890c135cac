// The frame planner where modules share their ambient occlusion: who asks whom, and what must be drawn again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "calibration/make.h"
#include "rendernode/plan/frame_plan.h"

namespace lfd {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A display of four modules and untextured lit items; each test changes what it is about.
class SharingPlans : public testing::Test {
 protected:
  SharingPlans() {
    auto made = make_display("640rc", 4);
    LFD_CHECK(made, made.error().message());
    display_ = *made;
    settings_.ao.shared_neighbours = 1;
  }

  void add_item(Point3<Physical> low, Point3<Physical> high) {
    GeometryItem item;
    item.index_count = 3;
    item.material = static_cast<std::uint32_t>(materials_.size());
    item.low = low;
    item.high = high;
    items_.push_back(item);
    materials_.emplace_back();
  }
  void add_seen_by_all() { add_item({-0.2, -0.2, -0.1}, {0.2, 0.2, 0.1}); }
  // Near the observers at the right: on the lines of few modules.
  void add_seen_by_few() { add_item({0.7, -0.05, 1.0}, {0.75, 0.05, 1.1}); }

  FramePlan plan() const {
    return plan_frame({&display_, &modules_, &items_, &materials_, {}, settings_, {}, "", drawn_, false});
  }

  static std::string why(const FramePlan& plan, const std::string& which) {
    const auto found = std::ranges::find(plan.left_out, which, &proto::LeftOut::which);
    return found == plan.left_out.end() ? "not left out" : found->why();
  }

  DisplayCalibration display_;
  std::vector<std::uint32_t> modules_{0, 1, 2, 3};
  std::vector<GeometryItem> items_;
  std::vector<MaterialFacts> materials_;
  RenderSettings settings_;
  const std::vector<std::string>* drawn_ = nullptr;
};

// Surfaces are told apart by normals, which sphere does not need for itself.
TEST_F(SharingPlans, NeighboursAreAskedWhereThereAreAny) {
  add_seen_by_all();
  settings_.ao.shared_neighbours = 0;
  EXPECT_FALSE(plan().share);
  EXPECT_FALSE(plan().sharing.has_neighbours());
  EXPECT_EQ(why(plan(), "share"), "not left out") << "nobody asked for it";
  settings_.ao.shared_neighbours = 2;
  EXPECT_TRUE(plan().share);
  EXPECT_TRUE(plan().normal);
  EXPECT_EQ(plan().sharing.layer_of_rank.size(), 4U);
  modules_ = {2};
  EXPECT_FALSE(plan().share);
  EXPECT_FALSE(plan().normal);
  EXPECT_EQ(why(plan(), "share"), "the node has one module");
  settings_.plan = false;
  EXPECT_TRUE(plan().share) << "everything is drawn";
  settings_.ao.enabled = false;
  EXPECT_FALSE(plan().share);
}

TEST_F(SharingPlans, ModulesThatSeeNothingShareNothing) {
  add_seen_by_few();
  std::vector<std::uint32_t> seeing;
  for (const auto k : modules_) {
    if (may_be_seen(display_, display_.modules[k], items_[0].low, items_[0].high)) seeing.push_back(k);
  }
  ASSERT_GT(seeing.size(), 0U);
  ASSERT_LT(seeing.size(), 4U);
  const Sharing planned = plan().sharing;
  EXPECT_EQ(planned.layer_of_rank, seeing);
  settings_.plan = false;
  EXPECT_EQ(plan().sharing, planned) << "the pictures are the same";
  settings_.plan = true;
  modules_ = {seeing[0], seeing[0] == 0 ? 3U : 0U};
  EXPECT_FALSE(plan().share);
  EXPECT_EQ(why(plan(), "share"), "no module has a neighbour that sees geometry");
}

// What a module has in hand is blurred: it cannot tell its neighbours what it found.
TEST_F(SharingPlans, ModulesThatShareAreDrawnAgainTogether) {
  add_seen_by_all();
  add_seen_by_few();
  const FramePlan first = plan();
  drawn_ = &first.inputs;
  EXPECT_THAT(plan().active_layers, IsEmpty());
  EXPECT_THAT(plan().unchanged_layers, ElementsAre(0, 1, 2, 3));
  items_[1].content = "moved";
  EXPECT_THAT(plan().active_layers, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(plan().unchanged_layers, IsEmpty());
  settings_.ao.shared_neighbours = 0;
  const FramePlan alone = plan();
  drawn_ = &alone.inputs;
  items_[1].content = "moved again";
  EXPECT_LT(plan().active_layers.size(), 4U) << "without sharing only those that see it";
}

}  // namespace
}  // namespace lfd
