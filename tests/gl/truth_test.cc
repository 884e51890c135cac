// Truth: what modules show against each pixel's own line cast into the scene in double precision.
#include <gtest/gtest.h>

#include "bench/reference/silhouette.h"
#include "bench/reference/truth.h"
#include "tests/support/rendering.h"
#include "tests/unit/reference_scenes.h"

namespace lfd {
namespace {

using reference::SceneMaker;
using testing_support::buffers;
using testing_support::context;
using testing_support::draw_once;
using testing_support::find_image;
using testing_support::state_of;

reference::Truth truth_of(const SceneData& data, const RegionOfInterest& roi, const DisplayCalibration& display,
                          std::uint32_t module) {
  Renderer renderer(context(), display, {module});
  const auto result = draw_once(renderer, state_of(data, roi), data.assets, {buffers({proto::POSITION})});
  const ModuleImage* image = find_image(result, module, proto::POSITION);
  EXPECT_NE(image, nullptr);
  const PictureF rendered{display.image.width, display.image.height, testing_support::floats_of(*image)};

  auto scene = reference::world_scene(data, roi);
  EXPECT_TRUE(scene);
  const DepthLimits limits = depth_limits(display, {});
  const reference::Intersector intersector(*scene);
  const reference::ModuleView view{display, display.modules[module], {limits.front, limits.back}};
  const auto hits = reference::cast_module(intersector, view);
  return reference::compare(hits, reference::near_silhouette(intersector, view, hits), rendered, result.position_origin,
                            roi.diagonal_m());
}

void expect_true(const reference::Truth& truth) {
  EXPECT_TRUE(reference::broken_bounds(truth).empty()) << testing::PrintToString(reference::broken_bounds(truth));
  printf("compared %zu median %.2e 99%% %.2e max %.2e mismatch %.4f%%\n", truth.compared, truth.median, truth.percent_99,
         truth.max, 100 * truth.mismatch_share);
}

SceneData sphere_before_wall() {
  SceneMaker maker;
  const auto plain = maker.add_material({});
  maker.add_mesh(reference::sphere({0.1F, 0, 0.1F}, 0.3F, 40), plain);
  maker.add_quad({-1, -1, -0.4F}, {1, -1, -0.4F}, {1, 1, -0.4F}, {-1, 1, -0.4F}, plain);
  maker.add_quad({-1, -0.4F, 0.8F}, {1, -0.4F, 0.8F}, {1, -0.4F, -0.5F}, {-1, -0.4F, -0.5F}, plain);
  return maker.data();
}

TEST(Truth, SphereBeforeWallLinear) {
  expect_true(truth_of(sphere_before_wall(), reference::same_spaces(), reference::one_module(Diffuser::kLinear, {512, 384}), 0));
}

TEST(Truth, SphereBeforeWallConical) {
  expect_true(truth_of(sphere_before_wall(), reference::same_spaces(), reference::one_module(Diffuser::kConical, {512, 384}), 0));
}

}  // namespace
}  // namespace lfd
