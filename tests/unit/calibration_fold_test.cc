// Folds are seen wherever in a cell they lie, and only where there are some.
#include "calibration/maps/fold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "calibration/maps/grid.h"
#include "calibration/random.h"

namespace lfd {
namespace {

// y = b, and x grows with a at the rate (a - 0.3)^2 + least: the Jacobian's determinant.
BicubicPatch valley(double least) {
  // The integral of that rate, its Bezier coefficients by blossoming: 1, a, a^2 and a^3 become 1, (r + s + t) / 3, ...
  const auto blossom = [least](double r, double s, double t) {
    return r * s * t / 3 - 0.3 * (r * s + s * t + t * r) / 3 + (0.09 + least) * (r + s + t) / 3;
  };
  const double x[4] = {blossom(0, 0, 0), blossom(0, 0, 1), blossom(0, 1, 1), blossom(1, 1, 1)};
  BicubicPatch patch;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      patch.point[4 * row + column] = {x[column], static_cast<double>(row) / 3};
    }
  }
  return patch;
}

TEST(Fold, IsSeenBetweenAllSamples) {
  ASSERT_NEAR(glm::determinant(valley(0.01).derivative({0.3, 0.8})), 0.01, 1e-15);
  // Its largest coefficient is 0.49 + least; 1/3000 of it counts as none.
  EXPECT_TRUE(keeps_orientation(valley(0.01), 1));
  EXPECT_TRUE(keeps_orientation(valley(0.001), 1));
  EXPECT_FALSE(keeps_orientation(valley(0), 1));
  EXPECT_FALSE(keeps_orientation(valley(-1e-9), 1)) << "as wide as 6e-5 of the cell";
  EXPECT_FALSE(keeps_orientation(valley(-0.01), 1));
  EXPECT_FALSE(keeps_orientation(valley(0.01), -1)) << "mirrored everywhere";
}

TEST(Fold, FlatAndPointlikeCellsHaveNoOrientation) {
  BicubicPatch flat = valley(0.1);
  for (glm::dvec2& p : flat.point) p.y = 2 * p.x;
  EXPECT_FALSE(keeps_orientation(flat, 1));
  EXPECT_FALSE(keeps_orientation(flat, -1));
  EXPECT_FALSE(keeps_orientation(BicubicPatch{}, 1));
}

TEST(Fold, ScaleMakesNoDifference) {
  for (const double scale : {1e-9, 1e4}) {
    BicubicPatch kept = valley(0.01), folded = valley(-1e-4);
    for (glm::dvec2& p : kept.point) p *= scale;
    for (glm::dvec2& p : folded.point) p *= scale;
    EXPECT_TRUE(keeps_orientation(kept, 1));
    EXPECT_FALSE(keeps_orientation(folded, 1));
  }
}

// Determinants of a patch at 65 x 65 places.
struct Sampled {
  double least = 0, greatest = 0;
};

Sampled sampled(const BicubicPatch& patch) {
  Sampled found{INFINITY, -INFINITY};
  for (int i = 0; i <= 64; ++i) {
    for (int j = 0; j <= 64; ++j) {
      const double determinant = glm::determinant(patch.derivative({i / 64.0, j / 64.0}));
      found = {std::min(found.least, determinant), std::max(found.greatest, determinant)};
    }
  }
  return found;
}

// Patches of unit cells, their nodes moved by normal errors.
TEST(Fold, AgreesWithDenseSamplesOfRandomPatches) {
  Random random(1);
  int folded = 0, kept = 0;
  for (int i = 0; i < 1000; ++i) {
    const double bent = 0.05 + 0.6 * random.unit();
    std::array<glm::dvec2, 16> node;
    for (int k = 0; k < 16; ++k) {
      const double x = random.normal(), y = random.normal();
      node[static_cast<std::size_t>(k)] = glm::dvec2(k % 4, k / 4) + bent * glm::dvec2(x, y);
    }
    const BicubicPatch patch = patch_between(node);
    const Sampled samples = sampled(patch);
    if (keeps_orientation(patch, 1)) {
      ++kept;
      EXPECT_GT(samples.least, 0) << "patch " << i;
    } else {
      ++folded;
      // The resolution: 1/3000 of the largest coefficient, and what can lie between the samples.
      EXPECT_LT(samples.least, 0.01 * samples.greatest) << "patch " << i;
    }
  }
  EXPECT_GT(folded, 300);
  EXPECT_GT(kept, 300);
}

// Whole grids: what is counted are the cells in which a dense raster meets places without a map.
TEST(Fold, OfGridsAreTheCellsWithPlacesWithoutAMap) {
  Random random(2);
  int folded = 0, kept = 0, disagreeing = 0;
  for (int i = 0; i < 12; ++i) {
    GridNodes nodes{9, 7, 0, 0, 1, 1, {}};
    for (int k = 0; k < 63; ++k) {
      const double x = random.normal(), y = random.normal();
      nodes.node.push_back({k % 9 + 0.05 * i * x, -k / 9 + 0.05 * i * y});
    }
    const GridMap map = *GridMap::make(nodes);
    int counted = 0;
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 8; ++column) {
        bool is_whole = true;
        for (int a = 0; a < 32 && is_whole; ++a) {
          for (int b = 0; b < 32 && is_whole; ++b) {
            is_whole = screen_from_image(map, {column + (a + 0.5) / 32, row + (b + 0.5) / 32}).has_value();
          }
        }
        const bool has_folded = map.has_folded(column, row);
        EXPECT_TRUE(has_folded || is_whole) << "grid " << i << ": " << column << ", " << row;
        counted += has_folded ? 1 : 0;
        disagreeing += has_folded && is_whole ? 1 : 0;
      }
    }
    EXPECT_NEAR(map.folded_share(), counted / 48.0, 1e-12);
    folded += counted;
    kept += 48 - counted;
  }
  EXPECT_GT(folded, 100);
  EXPECT_GT(kept, 300);
  EXPECT_LE(disagreeing, folded / 20) << "folds narrower than the raster";
}

}  // namespace
}  // namespace lfd
