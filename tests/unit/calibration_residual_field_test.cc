// Smoothed residuals: what is smooth is kept, noise is not, and neither are outliers.
#include "calibration/fit/residual_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "calibration/random.h"

namespace lfd {
namespace {

constexpr ImageSize kImage{256, 192};

// Samples of `field` with noise at the middles of 24 x 18 cells.
template <class Field>
std::vector<ResidualSample> samples_of(Field field, double noise_px) {
  Random random(1);
  std::vector<ResidualSample> samples;
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 18; ++j) {
      const PixelPoint p{(i + 0.5) * kImage.width / 24, (j + 0.5) * kImage.height / 18};
      const double u = random.normal(), v = random.normal();
      samples.push_back({p, field(p) + noise_px * glm::dvec2(u, v)});
    }
  }
  return samples;
}

template <class Field>
double worst_error(const ResidualField& found, Field field) {
  double worst = 0;
  for (double u = 8; u <= kImage.width - 8; u += 7) {
    for (double v = 8; v <= kImage.height - 8; v += 7) {
      worst = std::max(worst, glm::length(found.at({u, v}) - field({u, v})));
    }
  }
  return worst;
}

glm::dvec2 nothing(PixelPoint) { return glm::dvec2(0); }
glm::dvec2 quadratic(PixelPoint p) { return {1e-4 * p.x * p.x - 0.02 * p.y, 5e-5 * p.x * p.y + 1}; }
glm::dvec2 wave(PixelPoint p) { return {std::sin(p.x / 30), std::cos(p.x / 50 + p.y / 30)}; }

TEST(ResidualField, NoiseAloneIsNoField) {
  const auto found = smooth_residuals(kImage, samples_of(nothing, 0.1));
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_better);
  EXPECT_LT(worst_error(found->field, nothing), 0.1);
}

TEST(ResidualField, QuadraticFieldsCostNothing) {
  const auto found = smooth_residuals(kImage, samples_of(quadratic, 0));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_better);
  EXPECT_LT(worst_error(found->field, quadratic), 1e-6);  // rounding, by the condition of a stiff spline
}

TEST(ResidualField, WavesAreKeptAndNoiseIsNot) {
  const auto found = smooth_residuals(kImage, samples_of(wave, 0.1));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_better);
  EXPECT_LT(worst_error(found->field, wave), 0.2);
  EXPECT_LT(found->held_out_with_px, 0.2);
  EXPECT_GT(found->held_out_without_px, 0.9);  // the root mean square of both waves is 1
  EXPECT_NEAR(found->held_out_spread, 0.1, 0.02);
}

TEST(ResidualField, OutliersLeaveNoTrace) {
  auto samples = samples_of(wave, 0);
  const auto clean = smooth_residuals(kImage, samples);
  for (std::size_t i = 7; i < samples.size(); i += 50) samples[i].residual_px += glm::dvec2(20, -15);
  const auto found = smooth_residuals(kImage, samples);
  ASSERT_TRUE(clean && found);
  EXPECT_LT(worst_error(found->field, wave), 0.05);
}

TEST(ResidualField, FewSamplesSayNothing) {
  const std::vector<ResidualSample> few(19);
  EXPECT_FALSE(smooth_residuals(kImage, few));
}

}  // namespace
}  // namespace lfd
