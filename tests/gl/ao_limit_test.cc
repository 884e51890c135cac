// Rendered sphere samples against the method's own limit: feet of walls, corners, steps, borders and holes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "bench/reference/scene_maker.h"
#include "calibration/make.h"
#include "tests/gl/ao_stage.h"

namespace lfd {
namespace {

using reference::SceneMaker;
using testing_support::all_generators;
using testing_support::AoPixel;
using testing_support::AoStage;
using testing_support::from_above;
using testing_support::made;
using testing_support::plain_ao;

constexpr double kRadius = 0.12;          // about 14 pixels below
constexpr int kReferenceSamples = 10000;  // a pixel: 3e5 a patch

DisplayCalibration display_of(Diffuser diffuser) { return reference::one_module(diffuser, {128, 96}); }

// The same, but stretched: the sphere becomes an ellipsoid in physical space.
RegionOfInterest stretched_from_above() {
  RegionOfInterest roi = from_above();
  roi.physical_size = {1.5, 1.6, 0.9};
  return roi;
}

// Pixels of alike surroundings, and what each of them tends to.
struct Patch {
  const char* name;
  std::vector<AoPixel> pixels;
  std::vector<double> limits;
  double sum = 0;  // of all rendered values of its pixels
};

constexpr int kSamples = 256, kSeeds = 2;

// 4.5 standard errors of the mean: of the rendered samples if they were independent (the better generators only stay
// further below), and of the reference's. `grid` is for what does not fall with the number of samples: a sample meets
// the surface interpolated between four pixels, not its own line, so that an outline within the sphere is off by up to
// half a pixel, with alternating sign.
double tolerance_of(const Patch& patch, double grid) {
  double variance = 0;
  for (const double h : patch.limits) variance += h * (1 - h) * (1.0 / (kSeeds * kSamples) + 1.0 / kReferenceSamples);
  return 4.5 * std::sqrt(variance) / static_cast<double>(patch.limits.size()) + grid;
}

// Pixels of the drawn scene for which `wanted` holds; 30 of them.
template <class Wanted>
Patch choose(AoStage& stage, const char* name, int radii, Wanted wanted) {
  std::vector<AoPixel> found;
  for (const AoPixel& pixel : stage.draw(plain_ao(kRadius, 1, proto::AmbientOcclusion::UNIFORM))) {
    if (wanted(pixel)) found.push_back(pixel);
  }
  EXPECT_GE(found.size(), 10U) << name << ": too few pixels to say anything";
  Patch patch{name, testing_support::spread(found, 30), {}};
  AoSettings settings;
  settings.radii = radii;
  for (const AoPixel& pixel : patch.pixels) {
    const std::uint64_t seed = patch.limits.size() + 1;
    patch.limits.push_back(
        stage.limit(pixel.p, settings, {.radius_m = kRadius, .samples = kReferenceSamples, .seed = seed}).ao);
  }
  return patch;
}

// Draws with each generator and several seeds, and compares the mean of every patch.
void expect_limits(AoStage& stage, std::vector<Patch> patches, int radii, double grid,
                   const std::vector<proto::AmbientOcclusion::Generator>& generators) {
  for (const auto generator : generators) {
    proto::AmbientOcclusion ao = plain_ao(kRadius, kSamples, generator);
    ao.set_radii(radii);
    for (Patch& patch : patches) patch.sum = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
      ao.set_seed(seed);
      for (const AoPixel& pixel : stage.draw(ao)) {
        for (Patch& patch : patches) {
          if (std::ranges::find(patch.pixels, pixel.at, &AoPixel::at) != patch.pixels.end()) patch.sum += pixel.ao;
        }
      }
    }
    for (const Patch& patch : patches) {
      const double count = static_cast<double>(patch.pixels.size());
      const double limit = std::accumulate(patch.limits.begin(), patch.limits.end(), 0.0) / count;
      EXPECT_NEAR(patch.sum / (kSeeds * count), limit, tolerance_of(patch, grid))
          << patch.name << ", " << proto::AmbientOcclusion::Generator_Name(generator);
    }
  }
}

constexpr double kFloorY = -0.45, kWallZ = -0.45, kSideX = -0.8;
// R is 10 to 14 pixels: up to 28 of the sphere's 600 lie on an outline that crosses it, and each is right or wrong by
// less than half of its area; over 30 places that the grid cuts differently, 28 / 600 x sqrt(1 / 12) / sqrt(30) =
// 0.0025, of which 2.5 times.
constexpr double kGrid = 0.006;

bool on_floor(const AoPixel& pixel) { return std::abs(pixel.p.y - kFloorY) < 1e-4; }

struct Case {
  const char* name;
  Diffuser diffuser;
  bool stretched = false;
  bool perturbed = false;
};

class AoLimitRendered : public testing::TestWithParam<Case> {
 protected:
  AoStage stage(SceneData scene) const {
    DisplayCalibration display = display_of(GetParam().diffuser);
    if (GetParam().perturbed) display = perturbed(display, 7);
    return AoStage(std::move(scene), GetParam().stretched ? stretched_from_above() : from_above(), display);
  }

  // All of them once, and then the two between which the others lie.
  static const std::vector<proto::AmbientOcclusion::Generator>& generators() {
    static const std::vector<proto::AmbientOcclusion::Generator> kTwo{proto::AmbientOcclusion::UNIFORM,
                                                                      proto::AmbientOcclusion::POISSON_DISK};
    return GetParam().name == std::string("Linear") ? all_generators() : kTwo;
  }
};
INSTANTIATE_TEST_SUITE_P(Views, AoLimitRendered,
                         testing::Values(Case{"Linear", Diffuser::kLinear}, Case{"Conical", Diffuser::kConical},
                                         Case{"Stretched", Diffuser::kLinear, true},
                                         Case{"ConicalPerturbed", Diffuser::kConical, false, true}),
                         [](const auto& parameter) { return parameter.param.name; });

TEST_P(AoLimitRendered, AtTheFootOfAWall) {
  AoStage wall = stage(made("wall"));
  std::vector<Patch> patches;
  const auto at_distance = [&](const char* name, double share, int radii) {
    patches.push_back(choose(wall, name, radii, [&](const AoPixel& pixel) {
      return on_floor(pixel) && std::abs((pixel.p.z - kWallZ) / kRadius - share) < 0.05 &&
             std::abs(pixel.p.x + 0.4) < 0.2;
    }));
  };
  at_distance("d = 0.1 R", 0.1, 1);
  at_distance("d = R / 4", 0.25, 1);
  at_distance("d = R / 2", 0.5, 1);
  at_distance("d = 3 R / 4", 0.75, 1);
  expect_limits(wall, patches, 1, kGrid, generators());
}

// By the default curve, a = 0.5: what an open plane hides is taken away (the design's 0.18 at d = R / 4).
TEST_P(AoLimitRendered, AtTheFootOfAWallAfterTheCurve) {
  AoStage wall = stage(made("wall"));
  const Patch patch = choose(wall, "d = R / 4", 1, [&](const AoPixel& pixel) {
    return on_floor(pixel) && std::abs((pixel.p.z - kWallZ) / kRadius - 0.25) < 0.05 && std::abs(pixel.p.x + 0.4) < 0.2;
  });
  const AoSettings defaults;
  double expected = 0, found = 0;
  for (const double limit : patch.limits)
    expected += reference::post_curve(limit, defaults) / static_cast<double>(patch.limits.size());
  proto::AmbientOcclusion ao = plain_ao(kRadius, kSamples, proto::AmbientOcclusion::POISSON_DISK);
  ao.clear_curve();
  for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) {
    ao.set_seed(seed);
    for (const AoPixel& pixel : wall.draw(ao)) {
      if (std::ranges::find(patch.pixels, pixel.at, &AoPixel::at) != patch.pixels.end())
        found += pixel.ao / static_cast<double>(kSeeds * patch.pixels.size());
    }
  }
  EXPECT_NEAR(found, expected, tolerance_of(patch, kGrid)) << "this curve has slope 1";
  EXPECT_NEAR(found, 0.18, 0.02);
}

TEST_P(AoLimitRendered, InACorner) {
  AoStage corner = stage(made("corner"));
  const Patch patch = choose(corner, "corner", 1, [&](const AoPixel& pixel) {
    return on_floor(pixel) && pixel.p.z - kWallZ < 0.4 * kRadius && pixel.p.x - kSideX < 0.4 * kRadius;
  });
  expect_limits(corner, {patch}, 1, kGrid, generators());
}

// The open part before a wall is convex: whatever a shell of half the radius hides, the whole one hides too, so that
// the maximum is the largest radius's in every pixel, and noise cannot bias it.
TEST_P(AoLimitRendered, AtTheFootOfAWallTheLargestOfSeveralRadiiWins) {
  AoStage wall = stage(made("wall"));
  const Patch patch = choose(wall, "d = R / 4", 3, [&](const AoPixel& pixel) {
    return on_floor(pixel) && std::abs((pixel.p.z - kWallZ) / kRadius - 0.25) < 0.05 && std::abs(pixel.p.x + 0.4) < 0.2;
  });
  expect_limits(wall, {patch}, 3, kGrid, {proto::AmbientOcclusion::POISSON_DISK});
}

// A step no higher than 0.3 R: the whole shell looks over it, that of half the radius stands before a wall. With 256
// samples the two differ by several standard errors (below), so that the maximum of the noisy shares is biased upward
// by less than `bias`.
TEST_P(AoLimitRendered, BeforeALowStepASmallerRadiusWins) {
  constexpr float kY = kFloorY, kZ = -0.35F, kTop = static_cast<float>(kFloorY + 0.3 * kRadius);
  SceneMaker maker;
  const auto plain = maker.add_material({});
  maker.add_quad({-1, kY, 0.5F}, {1, kY, 0.5F}, {1, kY, kZ}, {-1, kY, kZ}, plain);
  maker.add_quad({-1, kY, kZ}, {1, kY, kZ}, {1, kTop, kZ}, {-1, kTop, kZ}, plain);
  maker.add_quad({-1, kTop, kZ}, {1, kTop, kZ}, {1, kTop, -1}, {-1, kTop, -1}, plain);
  AoStage steps = stage(maker.data());
  const Patch patch = choose(steps, "before the step", 2, [&](const AoPixel& pixel) {
    return on_floor(pixel) && (pixel.p.z - kZ) > 0 && (pixel.p.z - kZ) < 0.1 * kRadius &&
           std::abs(pixel.p.x + 0.4) < 0.2;
  });
  double bias = 0;
  AoSettings settings;
  settings.radii = 2;
  for (const AoPixel& pixel : patch.pixels) {
    const auto limit = steps.limit(pixel.p, settings, {.radius_m = kRadius, .samples = kReferenceSamples});
    const double lead = limit.hidden_share[1] - limit.hidden_share[0];
    ASSERT_GT(lead, 0.02) << "the smaller radius wins in the limit";
    // E max(a, b) - max(E a, E b) = E (a - b)+ for normal a - b of this deviation (independent at worst).
    const double sigma = std::sqrt((0.25 + 0.25) / kSamples), t = lead / sigma;
    bias += sigma * (std::exp(-t * t / 2) / std::sqrt(2 * M_PI) - t * 0.5 * std::erfc(t / std::sqrt(2.0))) /
            patch.pixels.size();
  }
  expect_limits(steps, {patch}, 2, kGrid + bias, generators());
}

class AoLimitAtEdges : public testing::TestWithParam<Diffuser> {};
INSTANTIATE_TEST_SUITE_P(Diffusers, AoLimitAtEdges, testing::Values(Diffuser::kLinear, Diffuser::kConical));

// Samples without an image, or over pixels without a surface, are open.
TEST_P(AoLimitAtEdges, BordersAndHoles) {
  SceneMaker maker;  // covers the screen's left border, and ends within the image at the right
  maker.add_quad({-9, -9, 0}, {0.4F, -9, 0}, {0.4F, 9, 0}, {-9, 9, 0}, maker.add_material({}));
  DisplayCalibration display = display_of(GetParam());
  display.modules[0].emitter.x = -0.9;
  AoStage plane(maker.data(), reference::same_spaces(), display);
  const int middle = display.image.height / 2;
  const auto near_middle = [&](const AoPixel& pixel) { return std::abs(pixel.at.row - middle) < 24; };
  const Patch border =
      choose(plane, "border", 1, [&](const AoPixel& pixel) { return near_middle(pixel) && pixel.at.column < 4; });
  const Patch hole =
      choose(plane, "hole", 1, [&](const AoPixel& pixel) { return near_middle(pixel) && pixel.p.x > 0.4 - 0.02; });
  const Patch inside =
      choose(plane, "inside", 1, [&](const AoPixel& pixel) { return near_middle(pixel) && std::abs(pixel.p.x) < 0.2; });
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LT(border.limits[i], 0.45);
    EXPECT_LT(hole.limits[i], 0.45);
    EXPECT_NEAR(inside.limits[i], 0.5, 0.01);
  }
  expect_limits(plane, {border, hole, inside}, 1, kGrid, all_generators());
}

}  // namespace
}  // namespace lfd
