// The frame planner: what it leaves out and why, and that "everything" leaves out nothing.
#include "rendernode/plan/frame_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "bench/reference/scene_maker.h"
#include "calibration/make.h"

namespace lfd {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// A display of four modules, one visible untextured lit item; each test changes what it is about.
class FramePlanning : public testing::Test {
 protected:
  FramePlanning() {
    auto made = make_display("640rc", 4);
    LFD_CHECK(made, made.error().message());
    display_ = *made;
    add_item({-0.2, -0.2, -0.1}, {0.2, 0.2, 0.1});
  }

  void add_item(Point3<Physical> low, Point3<Physical> high, MaterialFacts material = {}) {
    GeometryItem item;
    item.index_count = 3;
    item.material = static_cast<std::uint32_t>(materials_.size());
    item.low = low;
    item.high = high;
    items_.push_back(item);
    materials_.push_back(material);
  }

  FramePlan plan() const {
    return plan_frame(
        {&display_, &modules_, &items_, &materials_, lights_, settings_, buffers_, shared_, drawn_, is_software_});
  }

  static const proto::LeftOut* left_out(const FramePlan& plan, const std::string& what, const std::string& which) {
    const auto found = std::ranges::find_if(
        plan.left_out, [&](const proto::LeftOut& left) { return left.what() == what && left.which() == which; });
    return found == plan.left_out.end() ? nullptr : &*found;
  }

  static std::string why(const FramePlan& plan, const std::string& what, const std::string& which) {
    const auto* found = left_out(plan, what, which);
    return found != nullptr ? found->why() : "not left out";
  }

  DisplayCalibration display_;
  std::vector<std::uint32_t> modules_{0, 1, 2, 3};
  std::vector<GeometryItem> items_;
  std::vector<MaterialFacts> materials_;
  LightFacts lights_{true, true};
  RenderSettings settings_;
  BufferSet buffers_;
  bool is_software_ = false;
  std::string shared_;
  const std::vector<std::string>* drawn_ = nullptr;
};

TEST_F(FramePlanning, LeavesOutModulesWhoseInputsAreThoseOfTheImagesInHand) {
  items_[0].content = "a";
  const FramePlan first = plan();
  ASSERT_EQ(first.inputs.size(), 4U);
  EXPECT_THAT(first.unchanged_layers, IsEmpty());
  drawn_ = &first.inputs;
  const FramePlan again = plan();
  EXPECT_THAT(again.active_layers, IsEmpty());
  EXPECT_THAT(again.groups, IsEmpty());
  EXPECT_THAT(again.unchanged_layers, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(why(again, "module", "2"), "inputs unchanged since the last frame");
  items_[0].content = "b";
  EXPECT_THAT(plan().active_layers, ElementsAre(0, 1, 2, 3));
  items_[0].content = "a";
  shared_ = "other lights";
  EXPECT_THAT(plan().active_layers, ElementsAre(0, 1, 2, 3));
  shared_ = "";
  buffers_.bits = 1U << proto::NORMAL;
  EXPECT_THAT(plan().active_layers, ElementsAre(0, 1, 2, 3));
  buffers_ = {};
  settings_.plan = false;
  EXPECT_THAT(plan().active_layers, ElementsAre(0, 1, 2, 3)) << "everything is drawn";
}

TEST_F(FramePlanning, ALitTexturedSceneNeedsEverything) {
  materials_[0].texture_group = 0;
  const FramePlan p = plan();
  EXPECT_TRUE(p.z_prepass && p.position && p.normal && p.ao && p.blur && p.post);
  EXPECT_EQ(p.active_layers, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(p.left_out.size(), 1U);
  EXPECT_EQ(why(p, "correction", "colour"), "no module has a colour calibration");
}

TEST_F(FramePlanning, ModulesThatSeeNothingAreLeftOut) {
  // Near the observers at the right: on the lines of few modules.
  items_.clear();
  materials_.clear();
  add_item({0.7, -0.05, 1.0}, {0.75, 0.05, 1.1});
  const FramePlan p = plan();
  std::vector<std::uint32_t> expected;
  for (const auto k : modules_) {
    if (may_be_seen(display_, display_.modules[k], items_[0].low, items_[0].high)) expected.push_back(k);
    EXPECT_EQ(why(p, "module", std::to_string(k)),
              expected.empty() || expected.back() != k ? "no geometry in its view" : "not left out");
  }
  EXPECT_EQ(p.active_layers, expected);
  EXPECT_GT(expected.size(), 0U);
  EXPECT_LT(expected.size(), 4U);
}

TEST_F(FramePlanning, DrawsOutOfAModulesViewAreCounted) {
  add_item({-9, 5, -0.1}, {9, 6, 0.1});
  add_item({-9, -6, -0.1}, {9, -5, 0.1});
  const FramePlan p = plan();
  for (const auto k : modules_) {
    const auto* left = left_out(p, "draw", "of module " + std::to_string(k));
    ASSERT_NE(left, nullptr);
    EXPECT_EQ(left->count(), 2U);
    EXPECT_EQ(left->why(), "outside the module's view");
  }
  ASSERT_EQ(p.groups.size(), 1U);
  EXPECT_EQ(p.groups[0].draws.size(), 4U);
}

TEST_F(FramePlanning, AnEmptySceneNeedsNothing) {
  items_.clear();
  const FramePlan p = plan();
  EXPECT_FALSE(p.z_prepass || p.position || p.normal || p.ao || p.blur || p.post);
  EXPECT_TRUE(p.active_layers.empty() && p.groups.empty());
  EXPECT_EQ(why(p, "pass", "ao"), "no module sees geometry");
  EXPECT_EQ(why(p, "pass", "post"), "no module sees geometry");
  EXPECT_EQ(why(p, "pass", "z_prepass"), "no module sees geometry");
}

TEST_F(FramePlanning, WithoutTexturesThereIsNoPrepass) {
  const FramePlan p = plan();
  EXPECT_FALSE(p.z_prepass);
  EXPECT_EQ(why(p, "pass", "z_prepass"), "no texture is fetched: hidden fragments are cheap");
  EXPECT_EQ(why(p, "texture", "base colour"), "no material has one");
}

TEST_F(FramePlanning, OnTheCpuThereIsNoPrepassEither) {
  materials_[0].texture_group = 0;
  EXPECT_TRUE(plan().z_prepass);
  is_software_ = true;
  EXPECT_EQ(why(plan(), "pass", "z_prepass"), "a software rasteriser pays more for vertices than for hidden fragments");
  settings_.plan = false;
  EXPECT_TRUE(plan().z_prepass);
}

TEST_F(FramePlanning, UnlitScenesNeedNeitherOcclusionNorLights) {
  for (const bool by_material : {true, false}) {
    materials_[0].unlit = by_material;
    settings_.unlit = !by_material;
    const FramePlan p = plan();
    EXPECT_FALSE(p.ao || p.blur || p.post || p.position || p.normal);
    EXPECT_EQ(why(p, "pass", "ao"), "every surface is unlit");
    EXPECT_EQ(why(p, "pass", "blur"), "there is no ambient occlusion to blur");
    EXPECT_EQ(why(p, "pass", "post"), "every surface is unlit");
    EXPECT_EQ(why(p, "target", "position"), "nothing reads it");
    EXPECT_EQ(why(p, "target", "normal"), "nothing reads it");
  }
}

TEST_F(FramePlanning, OneLitSurfaceAmongUnlitOnesNeedsThem) {
  materials_[0].unlit = true;
  add_item({-0.1, -0.1, 0}, {0.1, 0.1, 0});
  const FramePlan p = plan();
  EXPECT_TRUE(p.ao && p.blur && p.post);
}

TEST_F(FramePlanning, TargetsFollowTheirReaders) {
  settings_.ao.enabled = false;
  lights_ = {};
  EXPECT_FALSE(plan().position || plan().normal) << "ambient light alone";
  lights_ = {true, false};
  EXPECT_TRUE(plan().normal && !plan().position) << "directional light";
  lights_ = {true, true};
  EXPECT_TRUE(plan().normal && plan().position) << "point light";
  lights_ = {};
  for (const auto kind : {proto::POSITION, proto::DEPTH, proto::AO}) {
    buffers_.bits = 1U << kind;
    EXPECT_TRUE(plan().position && !plan().normal) << proto::BufferKind_Name(kind);
  }
  buffers_.bits = 1U << proto::NORMAL;
  EXPECT_TRUE(plan().normal && !plan().position);
}

TEST_F(FramePlanning, NormalsAndPyramidsAreThereForMethodsThatReadThem) {
  lights_ = {};
  for (const occlusion::Method* method : occlusion::methods()) {
    settings_.ao.method = method;
    settings_.ao.parameters = occlusion::fallbacks(*method);
    EXPECT_EQ(plan().normal, method->normal) << method->name;
    EXPECT_EQ(plan().pyramid_levels, method->pyramid == occlusion::Pyramid::kNone ? 0 : 4) << method->name;
  }
}

TEST_F(FramePlanning, OcclusionIsLeftOutWhereItIsSwitchedOffAndDoneWhereItIsAskedFor) {
  settings_.ao.enabled = false;
  EXPECT_EQ(why(plan(), "pass", "ao"), "switched off");
  EXPECT_FALSE(plan().ao || plan().blur);
  settings_.ao.enabled = true;
  settings_.ao.blur_enabled = false;
  EXPECT_EQ(why(plan(), "pass", "blur"), "switched off");
  EXPECT_TRUE(plan().ao && !plan().blur);
  settings_.unlit = true;
  buffers_.bits = 1U << proto::AO;
  EXPECT_TRUE(plan().ao && plan().position) << "a file of it is wanted even where no light reads it";
}

TEST_F(FramePlanning, MaskedGroupsComeLastAndGroupsShareTextures) {
  materials_[0] = {2, true, false};
  add_item({-0.1, -0.1, 0}, {0.1, 0.1, 0}, {1, false, false});
  add_item({-0.1, -0.1, 0}, {0.1, 0.1, 0}, {1, false, true});
  add_item({-0.1, -0.1, 0}, {0.1, 0.1, 0}, {-1, true, false});
  const FramePlan p = plan();
  ASSERT_EQ(p.groups.size(), 3U);
  EXPECT_EQ(p.groups[0].texture_group, 1);
  EXPECT_EQ(p.groups[0].draws.size(), 8U) << "two items in four modules, lit or not";
  EXPECT_FALSE(p.groups[0].alpha_mask);
  EXPECT_TRUE(p.groups[1].alpha_mask && p.groups[2].alpha_mask);
}

TEST_F(FramePlanning, ColourNeedsPostProcessingOfUnlitScenesButNeitherLightsNorOcclusion) {
  settings_.unlit = true;
  display_.modules[2].color.emplace();
  const FramePlan p = plan();
  EXPECT_TRUE(p.color && p.post);
  EXPECT_FALSE(p.ao || p.blur || p.position || p.normal);
  EXPECT_EQ(why(p, "correction", "colour"), "not left out");
  modules_ = {0, 1, 3};
  EXPECT_FALSE(plan().color || plan().post) << "that module is another node's";
}

TEST_F(FramePlanning, AModuleWithColourIsDrawnEvenWhereItSeesNothing) {
  items_.clear();
  display_.modules[2].color.emplace();
  const FramePlan p = plan();
  EXPECT_EQ(p.active_layers, std::vector<std::uint32_t>{2});
  EXPECT_TRUE(p.color && p.post);
  EXPECT_FALSE(p.z_prepass || p.ao || p.blur || p.position || p.normal);
  EXPECT_EQ(why(p, "module", "1"), "no geometry in its view");
  EXPECT_EQ(why(p, "module", "2"), "not left out");
}

TEST_F(FramePlanning, EverythingLeavesNothingOut) {
  settings_.plan = false;
  items_[0].low = {50, 50, 0};
  items_[0].high = {51, 51, 0};
  materials_[0].unlit = true;
  lights_ = {};
  const FramePlan p = plan();
  EXPECT_TRUE(p.z_prepass && p.position && p.normal && p.ao && p.blur && p.post);
  EXPECT_EQ(p.active_layers.size(), 4U);
  ASSERT_EQ(p.groups.size(), 1U);
  EXPECT_EQ(p.groups[0].draws.size(), 4U);
  EXPECT_THAT(p.left_out,
              testing::Each(testing::Property(&proto::LeftOut::what, testing::AnyOf("texture", "correction"))))
      << "a texture that no material has cannot be drawn, a colour that no module has cannot be corrected";
}

// The bounds of the view may be generous; they may never lose a point that has an image.
TEST(FramePlanVisibility, NoPointWithAnImageIsOutOfView) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> side(-1, 1);
  auto made = make_display("640rc", 5);
  ASSERT_TRUE(made);
  const DisplayCalibration displays[] = {*made, perturbed(*made, 2), reference::one_module(Diffuser::kConical),
                                         *curved(*made, 0.9, false), *curved(perturbed(*made, 3), -4, true)};
  for (const DisplayCalibration& display : displays) {
    int seen = 0, dropped = 0;
    for (int i = 0; i < 3000; ++i) {
      const Point3<Physical> centre{2 * side(random), 1.2 * side(random), 1.5 * side(random)};
      const double half = 0.3 * (1 + side(random)) + 1e-3;
      const Point3<Physical> low{centre.x - half, centre.y - half, centre.z - half},
          high{centre.x + half, centre.y + half, centre.z + half};
      for (const auto& module : display.modules) {
        if (may_be_seen(display, module, low, high)) continue;
        ++dropped;
        for (int j = 0; j < 50; ++j) {
          const Point3<Physical> p{centre.x + half * side(random), centre.y + half * side(random),
                                   centre.z + half * side(random)};
          seen += image_from_physical(display, module, p) ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(seen, 0) << display.name;
    EXPECT_GT(dropped, 300) << display.name;
  }
}

}  // namespace
}  // namespace lfd
