// Metrics of ambient occlusion: against their definition written out, and known answers.
#include "bench/ao/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lfd::bench {
namespace {

Openness noise(ImageSize size, std::uint32_t seed, double holes) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 1);
  Openness picture{size, {}};
  for (int i = 0; i < size.width * size.height; ++i) {
    const float v = value(random);
    picture.value.push_back(value(random) < static_cast<float>(holes) ? -1 : v);
  }
  return picture;
}

// One window by the definition: means, variances and covariance by differences to the mean.
double ssim_of_window(const Openness& a, const Openness& b, int column, int row) {
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  const auto each = [&](const auto& take) {
    for (int v = 0; v < 11; ++v) {
      for (int u = 0; u < 11; ++u) {
        const auto i = static_cast<std::size_t>((row + v) * a.size.width + column + u);
        take(double{a.value[i]}, double{b.value[i]});
      }
    }
  };
  each([&](double p, double q) {
    x += p / 121;
    y += q / 121;
  });
  each([&](double p, double q) {
    xx += (p - x) * (p - x) / 121;
    yy += (q - y) * (q - y) / 121;
    xy += (p - x) * (q - y) / 121;
  });
  const double c1 = 1e-6, c2 = 9e-4;
  return (2 * x * y + c1) * (2 * xy + c2) / ((x * x + y * y + c1) * (xx + yy + c2));
}

TEST(AoMetrics, AreTheirDefinition) {
  const ImageSize size{40, 30};
  const Openness a = noise(size, 1, 0.003), b = noise(size, 2, 0.003);
  double ssim = 0, mae = 0, mean = 0;
  std::size_t windows = 0, pixels = 0;
  for (std::size_t i = 0; i < a.value.size(); ++i) {
    if (a.value[i] < 0 || b.value[i] < 0) continue;
    mae += std::abs(double{a.value[i]} - b.value[i]);
    mean += double{b.value[i]} - a.value[i];
    ++pixels;
  }
  for (int row = 0; row + 11 <= size.height; ++row) {
    for (int column = 0; column + 11 <= size.width; ++column) {
      bool whole = true;
      for (int v = 0; v < 11; ++v) {
        for (int u = 0; u < 11; ++u) {
          const auto i = static_cast<std::size_t>((row + v) * size.width + column + u);
          whole = whole && a.value[i] >= 0 && b.value[i] >= 0;
        }
      }
      if (!whole) continue;
      ssim += ssim_of_window(a, b, column, row);
      ++windows;
    }
  }
  ASSERT_GT(windows, 50U);
  ASSERT_LT(windows, 600U) << "holes leave some out";
  const AoDifference found = difference(a, b);
  EXPECT_EQ(found.pixels, pixels);
  EXPECT_EQ(found.windows, windows);
  EXPECT_NEAR(found.mae, mae / static_cast<double>(pixels), 1e-12);
  EXPECT_NEAR(found.mean, mean / static_cast<double>(pixels), 1e-12);
  EXPECT_NEAR(found.ssim, ssim / static_cast<double>(windows), 1e-9) << "sums over the whole picture lose some digits";
}

TEST(AoMetrics, EqualPicturesAreEqual) {
  const Openness a = noise({20, 20}, 5, 0);
  EXPECT_EQ(difference(a, a).mae, 0);
  EXPECT_NEAR(difference(a, a).ssim, 1, 1e-9);
}

TEST(AoMetrics, OfConstantsAreKnown) {
  const Openness a{{12, 12}, std::vector<float>(144, 0.25F)}, b{{12, 12}, std::vector<float>(144, 0.75F)};
  const AoDifference found = difference(a, b);
  EXPECT_EQ(found.mae, 0.5);
  EXPECT_EQ(found.mean, 0.5);
  EXPECT_EQ(found.windows, 4U);
  EXPECT_NEAR(found.ssim, (2 * 0.25 * 0.75 + 1e-6) / (0.0625 + 0.5625 + 1e-6), 1e-9);
}

TEST(AoMetrics, NothingToCompareIsNoError) {
  const Openness none{{12, 12}, std::vector<float>(144, -1)}, some = noise({12, 12}, 1, 0);
  EXPECT_EQ(difference(none, some).pixels, 0U);
  EXPECT_EQ(difference(some, none).windows, 0U);
}

}  // namespace
}  // namespace lfd::bench
