// Sharing in the renderer: planner, reuse and times change no picture; errors beside rays; what neighbours see in the
// open air.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/log.h"
#include "bench/reference/ray_occlusion.h"
#include "bench/reference/scene_maker.h"
#include "calibration/make.h"
#include "tests/gl/ao_scenes.h"
#include "tests/gl/ao_share_stage.h"
#include "tests/support/made.h"

namespace lfd {
namespace {

using reference::SceneMaker;
using testing_support::buffers;
using testing_support::context;
using testing_support::draw_once;
using testing_support::find_image;
using testing_support::floats_of;
using testing_support::LayerPicture;
using testing_support::made_data;
using testing_support::SharingStage;
using testing_support::state_of;
using testing_support::whole_scene;

DisplayCalibration display_of(int modules, ImageSize image = {96, 72}) {
  auto made = make_display("640rc", modules);
  LFD_CHECK(made, made.error().message());
  made->image = image;
  return *made;
}

std::vector<std::uint32_t> first_modules(std::uint32_t count) {
  std::vector<std::uint32_t> modules;
  for (std::uint32_t i = 0; i < count; ++i) modules.push_back(i);
  return modules;
}

proto::RenderSettings shared_march(int directions, int neighbours) {
  proto::RenderSettings settings;
  settings.mutable_ao()->set_method("march");
  settings.mutable_ao()->set_samples(directions);
  settings.mutable_ao()->mutable_shared()->set_neighbours(neighbours);
  return settings;
}

// The same images, in whatever order; an empty one is as good as one without a surface.
void expect_same(const FrameResult& a, const FrameResult& b, const std::string& what) {
  ASSERT_EQ(a.images.size(), b.images.size());
  for (const ModuleImage& one : a.images) {
    const ModuleImage* other = find_image(b, one.module, one.kind);
    ASSERT_NE(other, nullptr) << what;
    if (one.kind == proto::COLOR && (one.empty || other->empty)) continue;
    if (one.kind == proto::COLOR) {
      EXPECT_TRUE(*one.bytes == *other->bytes) << what << ", module " << one.module;
    } else {
      EXPECT_TRUE(floats_of(one) == floats_of(*other)) << what << ", module " << one.module;
    }
  }
}

const FrameOptions kOptions{.buffers = buffers({proto::POSITION, proto::AO})};

struct Variant {
  const char* name;
  std::function<void(proto::AmbientOcclusion&)> set;
};

const std::vector<Variant>& variants() {
  static const std::vector<Variant> kAll{
      {"defaults", [](auto&) {}},
      {"no blur", [](auto& ao) { ao.mutable_blur()->set_enabled(false); }},
      {"Gaussian", [](auto& ao) { ao.mutable_blur()->set_kind(proto::AmbientOcclusion::Blur::GAUSSIAN); }},
      {"half resolution", [](auto& ao) { ao.set_half_resolution(true); }},
      {"open air, three radii",
       [](auto& ao) {
         ao.mutable_shared()->set_open_air(true);
         ao.set_radii(3);
       }},
      {"sphere", [](auto& ao) { ao.set_method("sphere"); }},
      {"gtao", [](auto& ao) { ao.set_method("gtao"); }},
  };
  return kAll;
}

// The scene is so far aside that modules see it in part, or not at all.
TEST(AoShareUse, PlannerAndTimesPerModuleChangeNoPicture) {
  const DisplayCalibration display = display_of(8);
  const SceneData data = made_data("room");
  RegionOfInterest roi = whole_scene(data.scene, display);
  roi.physical_size *= 0.35;
  roi.physical_centre = {1.1, 0.1, 1.2};
  for (const Variant& variant : variants()) {
    proto::RenderSettings settings = shared_march(4, 2);
    variant.set(*settings.mutable_ao());
    Renderer renderer(context(), display, first_modules(8));
    const FrameResult planned = draw_once(renderer, state_of(data, roi, settings), data.assets, kOptions);
    FrameOptions timed = kOptions;
    timed.time_modules = true;
    timed.reuse = false;
    const FrameResult one_by_one = draw_once(renderer, state_of(data, roi, settings), data.assets, timed);
    settings.set_planner(proto::RenderSettings::EVERYTHING);
    const FrameResult everything = draw_once(renderer, state_of(data, roi, settings), data.assets, kOptions);
    expect_same(planned, one_by_one, std::string(variant.name) + ", timed");
    expect_same(planned, everything, std::string(variant.name) + ", everything");
    const auto has_pass = [](const FrameResult& result) {
      return std::ranges::any_of(result.report.pass(), [](const auto& pass) { return pass.pass() == "share"; });
    };
    EXPECT_TRUE(has_pass(planned) && has_pass(everything)) << variant.name;
  }
}

TEST(AoShareUse, AModuleAloneDrawsAsIfNothingWereShared) {
  const DisplayCalibration display = display_of(8);
  const SceneData data = made_data("room");
  const RegionOfInterest roi = whole_scene(data.scene, display);
  Renderer renderer(context(), display, {3});
  const FrameResult shared = draw_once(renderer, state_of(data, roi, shared_march(4, 2)), data.assets, kOptions);
  auto nothing_shared = shared_march(4, 0);
  nothing_shared.mutable_ao()->mutable_blur()->set_kind(
      proto::AmbientOcclusion::Blur::GEOMETRY);  // as shared findings are
  const FrameResult alone = draw_once(renderer, state_of(data, roi, nothing_shared), data.assets, kOptions);
  expect_same(shared, alone, "one module");
}

// Two nodes: each shares among its own modules.
TEST(AoShareUse, OtherNodesModulesDoNotMatter) {
  DisplayCalibration display = display_of(8);
  const SceneData data = made_data("room");
  const RegionOfInterest roi = whole_scene(data.scene, display);
  const std::vector<std::uint32_t> mine{4, 5, 6, 7};
  Renderer one(context(), display, mine);
  const FrameResult before = draw_once(one, state_of(data, roi, shared_march(4, 3)), data.assets, kOptions);
  for (const std::uint32_t other : {0U, 1U, 2U, 3U}) display.modules[other].emitter.x = -2 - other;
  Renderer two(context(), display, mine);
  expect_same(before, draw_once(two, state_of(data, roi, shared_march(4, 3)), data.assets, kOptions), "own modules");
}

// Of what moves, some modules see nothing themselves; their neighbours do.
TEST(AoShareUse, WhatMovedIsSeenByNeighboursToo) {
  const DisplayCalibration display = display_of(12);
  const SceneData data = made_data("depth-steps");
  RegionOfInterest roi = whole_scene(data.scene, display);
  roi.physical_size *= 0.35;
  roi.physical_centre = {1.1, 0.1, 1.2};
  proto::State state = state_of(data, roi, shared_march(4, 3));
  Renderer renderer(context(), display, first_modules(12));
  draw_once(renderer, state, data.assets, kOptions);
  for (int i = 0; i < state.scene().instance_size(); ++i) {
    (*state.mutable_scene()->mutable_instance(i)->mutable_world_from_mesh())[3] += 0.02;
    Renderer fresh(context(), display, first_modules(12));
    expect_same(draw_once(renderer, state, data.assets, kOptions), draw_once(fresh, state, data.assets, kOptions),
                fmt::format("instance {} moved", i));
  }
}

// Pixels of a layer and what rays say of them.
struct Judged {
  double mean_absolute = 0;
  std::size_t pixels = 0;
};

class Rays {
 public:
  Rays(const SceneData& data, const RegionOfInterest& roi, const DisplayCalibration& display, std::uint32_t module,
       double radius_m)
      : scene_(made_world(data, roi)), intersector_(scene_) {
    const DepthLimits limits = depth_limits(display, {});
    const reference::ModuleView view{display, display.modules[module], {limits.front, limits.back}};
    const auto hits = reference::cast_module(intersector_, view);
    truth_ = reference::ray_occlusion_of_module(intersector_, view, hits, {radius_m}, {.rays = 400, .seed = 1}).cosine;
  }

  // Of pixels with a surface in both for which `wanted` holds.
  template <class Wanted>
  Judged judge(const LayerPicture& picture, Wanted wanted) const {
    Judged judged;
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      if (truth_[i] < 0 || picture.ao[i] < 0 || !wanted(picture.position[i])) continue;
      judged.mean_absolute += std::abs(picture.ao[i] - truth_[i]);
      ++judged.pixels;
    }
    judged.mean_absolute /= static_cast<double>(std::max<std::size_t>(1, judged.pixels));
    return judged;
  }

 private:
  static reference::WorldScene made_world(const SceneData& data, const RegionOfInterest& roi) {
    auto scene = reference::world_scene(data, roi);
    LFD_CHECK(scene, scene.error().message());
    return *std::move(scene);
  }

  reference::WorldScene scene_;
  reference::Intersector intersector_;
  std::vector<float> truth_;
};

double mean_of(const LayerPicture& picture, const std::function<bool(const glm::vec4&)>& wanted) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < picture.ao.size(); ++i) {
    if (picture.ao[i] < 0 || !wanted(picture.position[i])) continue;
    sum += picture.ao[i];
    ++count;
  }
  EXPECT_GT(count, 20);
  return sum / count;
}

proto::AmbientOcclusion march(double radius_m, int directions, double thickness, int neighbours, bool open_air) {
  proto::AmbientOcclusion ao = shared_march(directions, neighbours).ao();
  ao.set_radius_m(radius_m);
  (*ao.mutable_parameter())["thickness"] = thickness;
  ao.mutable_shared()->set_open_air(open_air);
  return ao;
}

// 4 directions x 9 modules are 36 of the same generator: as good as 32 of one module. One seed's set may be luckier
// than another's by a few hundredths; the mean of four is compared.
TEST(AoShareUse, FourDirectionsOfNineModulesAreAsGoodAsThirtyTwoOfOne) {
  constexpr double kR = 0.12;
  const DisplayCalibration display = display_of(32, {160, 120});
  const SceneData data = made_data("ribbed-shell");
  const RegionOfInterest roi = whole_scene(data.scene, display);
  const std::vector<std::uint32_t> nine{12, 13, 14, 15, 16, 17, 18, 19, 20};
  SharingStage together(data, roi, display, nine), alone(data, roi, display, {16});
  const Rays rays(data, roi, display, 16, kR);
  const auto all = [](const glm::vec4&) { return true; };
  double shared = 0, single = 0, few = 0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    auto four = march(kR, 4, 1, 4, false), many = march(kR, 32, 1, 0, false);
    four.set_seed(seed);
    many.set_seed(seed);
    shared += rays.judge(together.draw(four, true)[4], all).mean_absolute / 4;
    few += rays.judge(together.draw(four, false)[4], all).mean_absolute / 4;
    single += rays.judge(alone.draw(many, false)[0], all).mean_absolute / 4;
  }
  fmt::print("error of 4 directions {:.5f}, of 4 shared by nine {:.5f}, of 32 alone {:.5f}\n", few, shared, single);
  EXPECT_LE(shared, single);
  EXPECT_LT(shared, 0.8 * few);
}

// A strip floats before a wall. Without a thickness all behind it is solid for a module alone: rays along the wall are
// hidden beside it, where the neighbours see the air behind.
TEST(AoShareUse, WhatANeighbourSeesInTheAirHidesNothing) {
  constexpr double kR = 0.3;
  SceneMaker maker;
  const auto plain = maker.add_material({true});
  maker.add_quad({-1.2F, -1, 0}, {1.2F, -1, 0}, {1.2F, 1, 0}, {-1.2F, 1, 0}, plain);
  maker.add_quad({-0.03F, -1, 0.2F}, {0.03F, -1, 0.2F}, {0.03F, 1, 0.2F}, {-0.03F, 1, 0.2F}, plain);
  const DisplayCalibration display = display_of(9, {192, 144});
  SharingStage stage(maker.data(), {}, display, first_modules(9));
  const Rays rays(maker.data(), {}, display, 4, kR);
  const auto beside = [](const glm::vec4& p) { return p.z < 0.1F && std::abs(p.x) < 0.15F && std::abs(p.y) < 0.2F; };
  const auto solid = stage.draw(march(kR, 16, 1000, 2, false), true);
  const auto cleared = stage.draw(march(kR, 16, 1000, 2, true), true);
  const Judged before = rays.judge(solid[4], beside), after = rays.judge(cleared[4], beside);
  ASSERT_GT(before.pixels, 200U);
  fmt::print("error beside a strip {:.4f}, with open air {:.4f}\n", before.mean_absolute, after.mean_absolute);
  EXPECT_GT(before.mean_absolute, 0.03);
  EXPECT_LT(after.mean_absolute, 0.5 * before.mean_absolute);
}

// A well as wide as it is deep: what is under the ground around it is air to nobody.
TEST(AoShareUse, AClosedWellStaysOccluded) {
  constexpr double kR = 0.3;
  constexpr float kHalf = 0.12F, kDeep = -0.24F;
  SceneMaker maker;
  const auto plain = maker.add_material({});
  for (const float side : {-1.0F, 1.0F}) {
    const float inner = side * kHalf, outer = side * 1.2F;
    const float left = std::min(inner, outer), right = std::max(inner, outer);
    maker.add_quad({left, -1, 0}, {right, -1, 0}, {right, 1, 0}, {left, 1, 0}, plain);
    maker.add_quad({-kHalf, left, 0}, {kHalf, left, 0}, {kHalf, right, 0}, {-kHalf, right, 0}, plain);
  }
  maker.add_quad({-kHalf, -kHalf, kDeep}, {kHalf, -kHalf, kDeep}, {kHalf, kHalf, kDeep}, {-kHalf, kHalf, kDeep}, plain);
  maker.add_quad({-kHalf, -kHalf, 0}, {-kHalf, -kHalf, kDeep}, {-kHalf, kHalf, kDeep}, {-kHalf, kHalf, 0}, plain);
  maker.add_quad({kHalf, kHalf, 0}, {kHalf, kHalf, kDeep}, {kHalf, -kHalf, kDeep}, {kHalf, -kHalf, 0}, plain);
  maker.add_quad({-kHalf, -kHalf, kDeep}, {-kHalf, -kHalf, 0}, {kHalf, -kHalf, 0}, {kHalf, -kHalf, kDeep}, plain);
  maker.add_quad({-kHalf, kHalf, 0}, {-kHalf, kHalf, kDeep}, {kHalf, kHalf, kDeep}, {kHalf, kHalf, 0}, plain);
  SharingStage stage(maker.data(), {}, display_of(9, {192, 144}), first_modules(9));
  const auto on_floor = [](const glm::vec4& p) { return std::abs(p.z - kDeep) < 1e-3F; };
  const auto closed = stage.draw(march(kR, 16, 1000, 2, false), true);
  const auto asked = stage.draw(march(kR, 16, 1000, 2, true), true);
  const double before = mean_of(closed[4], on_floor), after = mean_of(asked[4], on_floor);
  fmt::print("floor of a well {:.4f}, with open air {:.4f}\n", before, after);
  EXPECT_GT(before, 0.2);
  EXPECT_GT(after, 0.85 * before);
}

}  // namespace
}  // namespace lfd
