// Sample sets: counts, strata, spacing, symmetry, and that they fill the shell evenly.
#include "proto/occlusion/sample_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <set>
#include <string>

namespace lfd::occlusion {
namespace {

constexpr SampleGenerator kAll[] = {SampleGenerator::kPoissonDisk, SampleGenerator::kUniform,
                                    SampleGenerator::kJittered, SampleGenerator::kLatinSquare};

std::string name_of(const testing::TestParamInfo<SampleGenerator>& parameter) {
  constexpr const char* kNames[] = {"PoissonDisk", "Uniform", "Jittered", "LatinSquare"};
  return kNames[static_cast<std::size_t>(parameter.param)];
}

class AoSamples : public testing::TestWithParam<SampleGenerator> {};
INSTANTIATE_TEST_SUITE_P(Generators, AoSamples, testing::ValuesIn(kAll), name_of);

TEST_P(AoSamples, AreAsManyAsAskedForAndInTheSquare) {
  for (const int count : {1, 2, 3, 7, 8, 16, 31, 64, 100, 256}) {
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      const auto points = square_points({GetParam(), count, seed});
      ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
      for (const auto& p : points) {
        ASSERT_TRUE(p.x >= -1 && p.x < 1 && p.y >= -1 && p.y < 1) << p.x << " " << p.y;
      }
      for (const bool pairs : {false, true}) {
        EXPECT_EQ(shell_set({GetParam(), count, seed}, 0.8, pairs).size(), static_cast<std::size_t>(count));
        EXPECT_EQ(disk_set({GetParam(), count, seed}, pairs).size(), static_cast<std::size_t>(count));
      }
      EXPECT_EQ(cosine_set({GetParam(), count, seed}).size(), static_cast<std::size_t>(count));
    }
  }
}

TEST_P(AoSamples, DependOnTheSeedAlone) {
  EXPECT_EQ(square_points({GetParam(), 32, 5}), square_points({GetParam(), 32, 5}));
  EXPECT_NE(square_points({GetParam(), 32, 5}), square_points({GetParam(), 32, 6}));
  const SampleChoice choice{GetParam(), 32, 5};
  EXPECT_EQ(shell_set(choice, 0.8, false), shell_set(choice, 0.8, false));
  EXPECT_EQ(disk_set(choice, true), disk_set(choice, true));
  EXPECT_EQ(cosine_set(choice), cosine_set(choice));
}

TEST_P(AoSamples, PairsMirrorEachOtherExactly) {
  for (const int count : {2, 8, 9, 256}) {
    for (const auto& samples : {shell_set({GetParam(), count, 0}, 0.8, true), disk_set({GetParam(), count, 0}, true)}) {
      for (std::size_t i = 0; i + 1 < samples.size(); i += 2)
        EXPECT_EQ(glm::vec3(samples[i]), -glm::vec3(samples[i + 1]));
    }
  }
}

TEST_P(AoSamples, LieInTheShell) {
  for (const double shell : {0.0, 0.5, 0.8, 1.0}) {
    for (const auto& sample : shell_set({GetParam(), 256, 0}, shell, false)) {
      const double radius = glm::length(glm::dvec3(sample));
      EXPECT_GE(radius, shell - 1e-6) << "a float's rounding";
      EXPECT_LE(radius, 1 + 1e-6);
    }
  }
}

// Over many sets every direction and every part of the shell's volume is as likely. Tolerances: 5 standard errors of as
// many independent samples; stratified sets only stay further below them.
TEST_P(AoSamples, FillTheShellEvenly) {
  const double inner3 = std::pow(0.8, 3);
  constexpr int kSets = 2000, kBins = 10;
  const double count = 16.0 * kSets;
  glm::dvec3 mean(0), squares(0), products(0);
  double volume = 0, volume_squares = 0;
  std::vector<int> bins(kBins);
  for (std::uint32_t seed = 0; seed < kSets; ++seed) {
    for (const auto& sample : shell_set({GetParam(), 16, seed}, 0.8, false)) {
      const glm::dvec3 p(sample), d = glm::normalize(p);
      mean += d / count;
      squares += d * d / count;
      products += glm::dvec3(d.x * d.y, d.y * d.z, d.z * d.x) / count;
      const double share = (std::pow(glm::length(p), 3) - inner3) / (1 - inner3);  // of the volume within its radius
      volume += share / count;
      volume_squares += share * share / count;
      ++bins[static_cast<std::size_t>(std::clamp(static_cast<int>(share * kBins), 0, kBins - 1))];
    }
  }
  // x1 does not wrap around: points that keep their distance crowd at its ends, that is at the poles, by up to a
  // quarter. (Every pixel turns its set by a random rotation, so that no direction is preferred in a picture.)
  const bool crowded = GetParam() == SampleGenerator::kPoissonDisk;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean[axis], 0, 5 * std::sqrt(1.0 / 3 / count));
    EXPECT_NEAR(squares[axis], 1.0 / 3, crowded ? 0.25 / 3 : 5 * std::sqrt(4.0 / 45 / count))
        << "the variance of a squared coordinate is 4 / 45";
    EXPECT_NEAR(products[axis], 0, 5 * std::sqrt(1.0 / 15 / count)) << "that of a product of two is 1 / 15";
  }
  EXPECT_NEAR(volume, 0.5, 5 * std::sqrt(1.0 / 12 / count));
  EXPECT_NEAR(volume_squares, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / count));
  double chi_square = 0;
  for (const int bin : bins) chi_square += std::pow(bin - count / kBins, 2) / (count / kBins);
  EXPECT_LT(chi_square, 27.9) << "nine degrees of freedom exceed this once in a thousand";
}

std::size_t cell(double coordinate, int cells) { return static_cast<std::size_t>((coordinate + 1) / 2 * cells); }

// Equal parts of the disk are as likely; so are equal parts of the squared sine about the normal, which is what a
// cosine means. Five standard errors of independent samples.
TEST_P(AoSamples, FillDiskAndLobeEvenly) {
  constexpr int kSets = 2000;
  const double count = 16.0 * kSets;
  glm::dvec2 disk_mean(0), lobe_mean(0);
  double area = 0, sine2 = 0;
  for (std::uint32_t seed = 0; seed < kSets; ++seed) {
    for (const auto& p : disk_set({GetParam(), 16, seed}, false)) {
      ASSERT_LE(glm::length(glm::dvec2(p)), 1 + 1e-6);
      ASSERT_NEAR(glm::length(glm::dvec2(p)), p.w, 1e-6) << "floats";
      disk_mean += glm::dvec2(p) / count;
      area += glm::dot(glm::dvec2(p), glm::dvec2(p)) / count;
    }
    for (const auto& p : cosine_set({GetParam(), 16, seed})) {
      ASSERT_NEAR(glm::length(glm::dvec3(p)), 1, 1e-6) << "floats";
      ASSERT_GE(p.z, 0);
      ASSERT_TRUE(p.w >= 0 && p.w < 1);
      lobe_mean += glm::dvec2(p) / count;
      sine2 += (1 - p.z * p.z) / count;
    }
  }
  // x and y have variance 1/4, the shares 1/12.
  for (const double mean : {disk_mean.x, disk_mean.y, lobe_mean.x, lobe_mean.y})
    EXPECT_NEAR(mean, 0, 5 * std::sqrt(0.25 / count));
  for (const double share : {area, sine2}) EXPECT_NEAR(share, 0.5, 5 * std::sqrt(1 / (12 * count)));
}

TEST(AoSampleSets, JitteredHaveOnePointInEachCell) {
  struct Grid {
    int count, rows, columns;
  };
  for (const Grid& grid :
       {Grid{1, 1, 1}, Grid{7, 1, 7}, Grid{8, 2, 4}, Grid{12, 3, 4}, Grid{64, 8, 8}, Grid{256, 16, 16}}) {
    std::set<std::pair<std::size_t, std::size_t>> cells;
    for (const auto& p : square_points({SampleGenerator::kJittered, grid.count, 3})) {
      cells.insert({cell(p.x, grid.rows), cell(p.y, grid.columns)});
    }
    EXPECT_EQ(cells.size(), static_cast<std::size_t>(grid.count));
  }
}

TEST(AoSampleSets, LatinSquaresHaveOnePointInEachRowAndColumn) {
  for (const int count : {1, 2, 7, 8, 64, 256}) {
    std::set<std::size_t> rows, columns;
    for (const auto& p : square_points({SampleGenerator::kLatinSquare, count, 3})) {
      rows.insert(cell(p.x, count));
      columns.insert(cell(p.y, count));
    }
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
  }
}

// Smallest distance of two points; x2 wraps around, x1 does not.
double least_distance(const std::vector<glm::dvec2>& points) {
  double least = 4;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double dy = std::abs(points[i].y - points[j].y);
      least = std::min(least, std::hypot(points[i].x - points[j].x, std::min(dy, 2 - dy)));
    }
  }
  return least;
}

TEST(AoSampleSets, PoissonDisksKeepTheirDistanceAlsoAcrossTheSeam) {
  for (const int count : {4, 8, 32, 256}) {
    double poisson = 0, uniform = 0, nearest = 4;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      const double distance = least_distance(square_points({SampleGenerator::kPoissonDisk, count, seed}));
      nearest = std::min(nearest, distance);
      poisson += distance / 20;
      uniform += least_distance(square_points({SampleGenerator::kUniform, count, seed})) / 20;
    }
    EXPECT_GT(poisson, 1.5 * uniform);
    // The densest packing has a distance of 1.07 of sqrt(4 / count); throwing darts reaches well over half of it.
    EXPECT_GT(nearest, 0.5 * std::sqrt(4.0 / count));
  }
}

// Of a set on the disk, back in the square.
std::vector<glm::dvec2> in_square(const std::vector<glm::vec4>& disk) {
  std::vector<glm::dvec2> points;
  for (const glm::vec4& p : disk)
    points.push_back({2.0 * p.w * p.w - 1, std::atan2(static_cast<double>(p.y), static_cast<double>(p.x)) / M_PI});
  return points;
}

// The first k of 64 keep the distance that Poisson disks of k keep. Sets as they are made come in rows, or at random.
TEST_P(AoSamples, InSpreadOrderTheFirstFewFillTheSquare) {
  for (const int k : {2, 4, 7, 16}) {
    const auto first = [&](const std::vector<glm::vec4>& set) { return in_square({set.begin(), set.begin() + k}); };
    double spread = 0, made = 0, poisson = 0;
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
      const SampleChoice choice{GetParam(), 64, seed};
      auto set = disk_set(choice, false);
      made += least_distance(first(set));
      spread_prefixes(set, choice);
      spread += least_distance(first(set));
      poisson += least_distance(square_points({SampleGenerator::kPoissonDisk, k, seed}));
    }
    // 64 points to choose from cost the sixteenth a tenth of its distance.
    EXPECT_GT(spread, 0.85 * poisson) << k;
    EXPECT_LT(made, (GetParam() == SampleGenerator::kPoissonDisk ? 1 : 0.8) * poisson) << k;
  }
}

TEST_P(AoSamples, InSpreadOrderAreTheSameSamplesAndPairsStayPairs) {
  const auto sorted = [](std::vector<glm::vec4> samples) {
    std::ranges::sort(samples, {}, [](glm::vec4 p) { return std::array{p.x, p.y, p.z, p.w}; });
    return samples;
  };
  for (const int count : {1, 2, 9, 64}) {
    const SampleChoice choice{GetParam(), count, 3};
    for (const bool pairs : {false, true}) {
      for (const auto& made : {shell_set(choice, 0.8, pairs), disk_set(choice, pairs), cosine_set(choice)}) {
        auto ordered = made;
        spread_prefixes(ordered, choice);
        EXPECT_EQ(sorted(ordered), sorted(made)) << count;
        EXPECT_TRUE(count < 64 || ordered != made);
        if (count == 1 || glm::vec3(made[0]) != -glm::vec3(made[1])) continue;
        for (std::size_t i = 0; i + 1 < ordered.size(); i += 2)
          EXPECT_EQ(glm::vec3(ordered[i]), -glm::vec3(ordered[i + 1])) << count << ", " << i;
      }
    }
  }
}

}  // namespace
}  // namespace lfd::occlusion
