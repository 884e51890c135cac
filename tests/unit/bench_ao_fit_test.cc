// Curves fitted to pictures: known answers, and whose pictures a fit may see.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bench/ao/curve_fit.h"
#include "bench/ao/judge.h"

namespace lfd::bench {
namespace {

Openness uniform_picture(int count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  Openness picture{{count, 1}, {}};
  for (int i = 0; i < count; ++i) picture.value.push_back(value(random));
  return picture;
}

JointHistogram histogram_of(const Openness& method, const Openness& reference) {
  JointHistogram histogram;
  histogram.add(method, reference);
  return histogram;
}

TEST(AoFit, FindsTheCurveThatMadeAPicture) {
  const Openness method = uniform_picture(20000, 1);
  for (const occlusion::Curve& truth :
       {occlusion::Curve{0, 1, 1}, {0, 1, 2.5}, {0.3, 1, 3}, {0, 0.7, 1}, {-0.2, 1.1, 1}}) {
    const Openness reference = curved(method, truth);
    const JointHistogram histogram = histogram_of(method, reference);
    const occlusion::Curve found = fit_curve(histogram, {0, 1, 1});
    // Bins are 1/128 wide: within one, openness before and after may be off by half a bin each, the latter times the
    // slope of 3.
    EXPECT_LT(difference(reference, curved(method, found)).mae, 0.006) << truth.a << " " << truth.b << " " << truth.c;
    EXPECT_LE(histogram.mae(found), histogram.mae(truth) + 1e-3);
  }
}

TEST(AoFit, IsNeverWorseThanWhatItStartedFrom) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    const JointHistogram histogram = histogram_of(uniform_picture(500, seed), uniform_picture(500, seed + 100));
    const occlusion::Curve start{0.5, 1.01, 8}, identity{0, 1, 1}, found = fit_curve(histogram, start);
    EXPECT_LE(histogram.mae(found), histogram.mae(start));
    EXPECT_LE(histogram.mae(found), histogram.mae(identity));
  }
}

TEST(AoFit, CountsErrorsAsPicturesHaveThem) {
  const Openness method = uniform_picture(5000, 3), reference = uniform_picture(5000, 4);
  const occlusion::Curve curve{0.1, 0.9, 2};
  EXPECT_NEAR(histogram_of(method, reference).mae(curve), difference(reference, curved(method, curve)).mae, 0.002)
      << "a quarter of a bin";
}

TEST(AoFit, LeavesOutPixelsWithoutSurface) {
  Openness method = uniform_picture(100, 5), reference = uniform_picture(100, 6);
  for (std::size_t i = 0; i < 50; ++i) method.value[i] = -1;
  for (std::size_t i = 50; i < 100; ++i) reference.value[i] = -1;
  EXPECT_TRUE(histogram_of(method, reference).empty());
  EXPECT_EQ(curved(method, {0, 1, 2}).value[0], -1) << "what has no surface keeps none";
}

// A scene's own pictures must not shape the curve that it is judged with.
TEST(AoFit, SeesOtherScenesOnly) {
  Rung rung;
  rung.name = "8 samples";
  rung.settings.set_method("sphere");
  const Openness method = uniform_picture(5000, 7);
  const JointHistogram squared = histogram_of(method, curved(method, {0, 1, 2})),
                       cubed = histogram_of(method, curved(method, {0, 1, 3}));
  Fits fits;
  EXPECT_FALSE(fits.without("one", rung, 0.04));
  fits.add("one", rung, 0.04, squared);
  EXPECT_FALSE(fits.without("one", rung, 0.04)) << "there is no other scene";
  fits.add("two", rung, 0.04, cubed);
  fits.add("two", rung, 0.16, squared);
  ASSERT_TRUE(fits.without("one", rung, 0.04));
  EXPECT_LT(cubed.mae(*fits.without("one", rung, 0.04)), 0.006);
  EXPECT_LT(squared.mae(*fits.without("two", rung, 0.04)), 0.006);
  EXPECT_FALSE(fits.without("two", rung, 0.16)) << "another radius is another picture";
  Rung other = rung;
  other.name = "16 samples";
  EXPECT_FALSE(fits.without("one", other, 0.04));
  EXPECT_TRUE(fits.over_all(rung));
}

TEST(AoFit, JudgesWhereAMaskSays) {
  const Openness reference{{4, 1}, {0.5F, 0.5F, 0.5F, -1}}, method{{4, 1}, {0.6F, 0.9F, 0.5F, 0}},
      mask{{4, 1}, {1, 0, 1, 1}};
  EXPECT_NEAR(mae_where(reference, method, mask), 0.05, 1e-6);
  EXPECT_EQ(mae_where(reference, method, Openness{{4, 1}, {0, 0, 0, 1}}), 0) << "no pixel of it has a surface";
}

}  // namespace
}  // namespace lfd::bench
