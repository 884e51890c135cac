// The frame planner where a test pattern is shown: it alone is drawn, by all layers, and the report says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/make.h"
#include "rendernode/plan/frame_plan.h"
#include "tests/support/unwrapped.h"

namespace lfd {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Property;

// A display of four modules of which a node draws three, and a lit item that all see.
class PatternPlanning : public testing::Test {
 protected:
  PatternPlanning() {
    GeometryItem item;
    item.low = {-0.2, -0.2, -0.1};
    item.high = {0.2, 0.2, 0.1};
    items_.push_back(item);
    settings_.pattern.kind = PatternKind::kNumber;
  }

  FramePlan plan() const {
    return plan_frame({&display_, &modules_, &items_, &materials_, {true, true}, settings_, buffers_, "", drawn_});
  }

  DisplayCalibration display_ = testing_support::unwrapped(make_display("640rc", 4));
  std::vector<std::uint32_t> modules_{3, 0, 1};
  std::vector<GeometryItem> items_;
  std::vector<MaterialFacts> materials_{MaterialFacts{}};
  RenderSettings settings_;
  BufferSet buffers_;
  const std::vector<std::string>* drawn_ = nullptr;
};

TEST_F(PatternPlanning, NothingElseIsDrawn) {
  display_.modules[0].color.emplace();
  settings_.ao.shared_neighbours = 1;
  buffers_.bits = 1U << proto::POSITION | 1U << proto::AO;
  for (const bool planned : {true, false}) {
    settings_.plan = planned;
    const FramePlan p = plan();
    EXPECT_TRUE(p.pattern);
    EXPECT_FALSE(p.z_prepass || p.position || p.normal || p.ao || p.blur || p.post);
    EXPECT_FALSE(p.upsample || p.share || p.bent || p.color);
    EXPECT_EQ(p.pyramid_levels + p.guard_band_px, 0);
    EXPECT_THAT(p.groups, IsEmpty());
    EXPECT_THAT(p.active_layers, ElementsAre(0, 1, 2));
    EXPECT_THAT(p.pattern_layers, ElementsAre(0, 1, 2));
  }
  settings_.pattern = {};
  EXPECT_FALSE(plan().pattern);
  EXPECT_THAT(plan().pattern_layers, IsEmpty());
  EXPECT_TRUE(plan().ao && plan().post && plan().color);
}

TEST_F(PatternPlanning, TheReportSaysWhatIsLeftOutAndWhy) {
  const FramePlan p = plan();
  EXPECT_THAT(p.left_out, Each(Property(&proto::LeftOut::why, "a test pattern is shown")));
  for (const char* which : {"z_prepass", "gbuffer", "ao", "blur", "post", "position", "normal", "colour"})
    EXPECT_THAT(p.left_out, Contains(Property(&proto::LeftOut::which, which)));
  EXPECT_THAT(p.left_out,
              Contains(testing::AllOf(Property(&proto::LeftOut::what, "draw"), Property(&proto::LeftOut::count, 3))));
}

TEST_F(PatternPlanning, LayersOfModulesThatDoNotShowItAreDrawnBlack) {
  settings_.pattern.modules = {{1, 2}, {3, 3}};
  const FramePlan p = plan();
  EXPECT_THAT(p.active_layers, ElementsAre(0, 1, 2));
  EXPECT_THAT(p.pattern_layers, ElementsAre(0, 2)) << "modules 3 and 1";
}

TEST_F(PatternPlanning, PicturesInHandStayTrueWhateverMoves) {
  materials_[0].unlit = true;  // so that the scene needs no more passes than the pattern
  const FramePlan first = plan();
  drawn_ = &first.inputs;
  items_[0].content = "moved";
  EXPECT_THAT(plan().active_layers, IsEmpty());
  EXPECT_THAT(plan().unchanged_layers, ElementsAre(0, 1, 2));
  settings_.pattern = {};
  EXPECT_THAT(plan().unchanged_layers, IsEmpty()) << "the scene is another picture";
  items_[0].content = "";
  EXPECT_THAT(plan().unchanged_layers, IsEmpty()) << "even one without a content";
}

}  // namespace
}  // namespace lfd
