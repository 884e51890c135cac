// Silhouettes of the reference: there where surfaces end, and nowhere else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/reference/scene_maker.h"
#include "bench/reference/silhouette.h"

namespace lfd::reference {
namespace {

struct Marked {
  HitImage image;
  std::vector<std::uint8_t> near;
  WorldScene scene;

  int count() const { return static_cast<int>(std::ranges::count(near, 1)); }
};

Marked marked_in(const SceneMaker& maker, const DisplayCalibration& display) {
  Marked marked{{}, {}, scene_of(maker)};
  const Intersector intersector(marked.scene);
  const ModuleView view{display, display.modules[0], {}};
  marked.image = cast_module(intersector, view);
  marked.near = near_silhouette(intersector, view, marked.image);
  return marked;
}

class SilhouetteOf : public testing::TestWithParam<Diffuser> {};
INSTANTIATE_TEST_SUITE_P(Diffusers, SilhouetteOf, testing::Values(Diffuser::kLinear, Diffuser::kConical),
                         [](const auto& parameter) {
                           return parameter.param == Diffuser::kLinear ? "Linear" : "Conical";
                         });

TEST_P(SilhouetteOf, SlantsAndCreasesHaveNone) {
  // A folded screen: 40 strips 4 cm wide, whose depth goes up and down by 1 cm, all of them facing the viewer.
  SceneMaker maker;
  const std::uint32_t material = maker.add_material({});
  for (int i = -40; i < 40; ++i) {
    // Not right = left + 0.04F: that would leave hairs of 1e-7 m between strips, and the reference sees through them.
    const float left = 0.04F * static_cast<float>(i), right = 0.04F * static_cast<float>(i + 1);
    const float z_left = i % 2 == 0 ? 0 : 0.01F, z_right = i % 2 == 0 ? 0.01F : 0;
    maker.add_quad({left, -1, z_left}, {right, -1, z_right}, {right, 1, z_right}, {left, 1, z_left}, material);
  }
  const Marked marked = marked_in(maker, one_module(GetParam(), {160, 120}));
  EXPECT_THAT(marked.image.hit, testing::Each(testing::Ne(std::nullopt)));
  EXPECT_EQ(marked.count(), 0);
}

TEST_P(SilhouetteOf, ARoomOfTwelveTrianglesHasNoneInside) {
  // Floor, ceiling, sides and back wall, and a ramp across the floor: no surface hides another, but the slopes
  // reach 30.
  SceneMaker maker;
  const std::uint32_t m = maker.add_material({});
  const float x = 2, y = 1, back = -1, front = 1;
  maker.add_quad({-x, -y, front}, {x, -y, front}, {x, -y, back}, {-x, -y, back}, m);
  maker.add_quad({-x, y, back}, {x, y, back}, {x, y, front}, {-x, y, front}, m);
  maker.add_quad({-x, -y, front}, {-x, -y, back}, {-x, y, back}, {-x, y, front}, m);
  maker.add_quad({x, -y, back}, {x, -y, front}, {x, y, front}, {x, y, back}, m);
  maker.add_quad({-x, -y, back}, {x, -y, back}, {x, y, back}, {-x, y, back}, m);
  maker.add_quad({-x, -y, 0}, {x, -y, 0}, {x, 0, back}, {-x, 0, back}, m);
  const Marked marked = marked_in(maker, one_module(GetParam(), {160, 120}));
  EXPECT_THAT(marked.image.hit, testing::Each(testing::Ne(std::nullopt)));
  EXPECT_EQ(marked.count(), 0);
}

TEST_P(SilhouetteOf, TheRimOfASphereIsMarkedAndNothingElse) {
  for (const bool with_wall : {false, true}) {
    SceneMaker maker;
    const std::uint32_t material = maker.add_material({});
    maker.add_mesh(sphere({0, 0, 0}, 0.3F, 60), material);
    if (with_wall) maker.add_quad({-5, -5, -0.4F}, {5, -5, -0.4F}, {5, 5, -0.4F}, {-5, 5, -0.4F}, material);
    const Marked marked = marked_in(maker, one_module(GetParam(), {200, 150}));
    const auto surface_at = [&](PixelIndex i) {  // 0 nothing, 1 sphere, 2 wall
      const auto& hit = marked.image.at(i);
      return hit ? 1 + static_cast<int>(marked.scene.triangle[hit->triangle].instance) : 0;
    };
    int rim = 0;
    for (int row = 1; row < 149; ++row) {
      for (int column = 1; column < 199; ++column) {
        const PixelIndex p{column, row};
        bool at_rim = false;
        for (int i = 0; i < 9; ++i)
          at_rim = at_rim || surface_at({column + i % 3 - 1, row + i / 3 - 1}) != surface_at(p);
        const bool expected = at_rim && surface_at(p) != 0;
        ASSERT_EQ(marked.near[static_cast<std::size_t>(row) * 200 + column] != 0, expected) << column << ", " << row;
        rim += expected;
      }
    }
    EXPECT_GT(rim, 150);
  }
}

TEST_P(SilhouetteOf, AStepIsMarkedOnlyFromWhereItsRiserIsHidden) {
  // Left half 30 cm nearer than the right half, a riser between them that looks to the right and is 2 mm deep in x. The
  // gap between neighbouring pixels is the same; only where the riser is seen is the surface whole.
  SceneMaker maker;
  const std::uint32_t material = maker.add_material({});
  maker.add_quad({-3, -3, 0.3F}, {0, -3, 0.3F}, {0, 3, 0.3F}, {-3, 3, 0.3F}, material);
  maker.add_quad({0, -3, 0.3F}, {0.002F, -3, 0}, {0.002F, 3, 0}, {0, 3, 0.3F}, material);
  maker.add_quad({0.002F, -3, 0}, {3, -3, 0}, {3, 3, 0}, {0.002F, 3, 0}, material);
  DisplayCalibration display = one_module(GetParam(), {160, 120});
  for (const double ex : {-0.6, 0.6}) {
    display.modules[0].emitter.x = ex;
    const Marked marked = marked_in(maker, display);
    const bool riser_is_seen = ex < 0;  // lines then run to the right, to viewers who look at it from there
    if (riser_is_seen) {
      EXPECT_EQ(marked.count(), 0);
    } else {
      // One column on either side; a conical diffuser bends the edge a little: two more where it moves to the next
      // column.
      EXPECT_GE(marked.count(), 2 * 120);
      EXPECT_LE(marked.count(), 2 * 120 + 8);
    }
  }
}

TEST(Silhouette, DiagonalNeighboursCount) {
  // A quad whose corner pixels touch nothing but the background diagonally is marked all around, and not inside.
  SceneMaker maker;
  maker.add_quad({-0.4F, -0.225F, 0}, {0.4F, -0.225F, 0}, {0.4F, 0.225F, 0}, {-0.4F, 0.225F, 0},
                 maker.add_material({}));
  const Marked marked = marked_in(maker, one_module(Diffuser::kLinear, {40, 40}));
  EXPECT_EQ(marked.count(), 4 * 19) << "the border of 20 x 20 pixels";
}

}  // namespace
}  // namespace lfd::reference
