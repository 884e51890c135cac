// Which modules share, how the samples are dealt among them, and where their noise begins.
#include "rendernode/plan/sharing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "calibration/make.h"
#include "rendernode/passes/gpu_sharing.h"

namespace lfd {
namespace {

using testing::ElementsAre;

DisplayCalibration display_of(int modules) {
  auto made = make_display("640rc", modules);
  LFD_CHECK(made, made.error().message());
  return *made;
}

std::vector<std::uint32_t> numbers(std::uint32_t count) {
  std::vector<std::uint32_t> all(count);
  for (std::uint32_t i = 0; i < count; ++i) all[i] = i;
  return all;
}

// The layers a layer shares with, itself among them, from left to right.
std::vector<std::uint32_t> shares_with(const Sharing& sharing, std::size_t layer) {
  std::vector<std::uint32_t> layers;
  for (std::uint32_t rank = sharing.window[layer].first; rank <= sharing.window[layer].last; ++rank)
    layers.push_back(sharing.layer_of_rank[rank]);
  return layers;
}

TEST(Sharing, IsAmongTheNextOnEachSideAsFarAsThereAreAny) {
  const Sharing sharing = share_among(display_of(6), numbers(6), std::vector<bool>(6, true), 2);
  EXPECT_THAT(shares_with(sharing, 0), ElementsAre(0, 1, 2));
  EXPECT_THAT(shares_with(sharing, 1), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(shares_with(sharing, 3), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(shares_with(sharing, 5), ElementsAre(3, 4, 5));
  EXPECT_TRUE(sharing.has_neighbours());
}

TEST(Sharing, AmongFewerModulesThanAskedForIsAmongAll) {
  const Sharing sharing = share_among(display_of(3), numbers(3), std::vector<bool>(3, true), 8);
  for (std::size_t layer = 0; layer < 3; ++layer) EXPECT_THAT(shares_with(sharing, layer), ElementsAre(0, 1, 2));
  EXPECT_FALSE(share_among(display_of(1), {0}, {true}, 8).has_neighbours());
  EXPECT_FALSE(share_among(display_of(3), numbers(3), {false, true, false}, 8).has_neighbours());
  EXPECT_FALSE(share_among(display_of(3), numbers(3), {true, false, true}, 1).has_neighbours());
}

// Modules 7, 1, 4 of a display whose emitters stand the other way round.
TEST(Sharing, GoesByEmittersNotByNumbers) {
  DisplayCalibration display = display_of(8);
  for (ModuleCalibration& module : display.modules) module.emitter.x = -module.emitter.x;
  const Sharing sharing = share_among(display, {7, 1, 4}, {true, true, true}, 1);
  EXPECT_THAT(sharing.layer_of_rank, ElementsAre(0, 2, 1));
  EXPECT_THAT(shares_with(sharing, 0), ElementsAre(0, 2));
  EXPECT_THAT(shares_with(sharing, 1), ElementsAre(2, 1));
  EXPECT_THAT(shares_with(sharing, 2), ElementsAre(0, 2, 1));
}

TEST(Sharing, AModuleThatIsNotDrawnLeavesAHole) {
  const Sharing sharing = share_among(display_of(6), numbers(6), {true, true, false, true, false, true}, 2);
  EXPECT_THAT(shares_with(sharing, 0), ElementsAre(0, 1));
  EXPECT_THAT(shares_with(sharing, 1), ElementsAre(0, 1, 3));
  EXPECT_THAT(shares_with(sharing, 3), ElementsAre(1, 3, 5));
  EXPECT_THAT(shares_with(sharing, 5), ElementsAre(3, 5));
  EXPECT_THAT(shares_with(sharing, 2), ElementsAre());
}

TEST(Sharing, NeighboursHaveDifferentPartsOfTheSamples) {
  for (const int each_side : {1, 2, 4, 8}) {
    const Sharing sharing = share_among(display_of(40), numbers(40), std::vector<bool>(40, true), each_side);
    for (std::size_t layer = 0; layer < 40; ++layer) {
      std::set<int> parts;
      const auto with = shares_with(sharing, layer);
      for (const std::uint32_t other : with) parts.insert(sharing.part[other]);
      EXPECT_EQ(parts.size(), with.size());
      EXPECT_GE(*parts.begin(), 0);
      EXPECT_LT(*parts.rbegin(), sharing.parts);
    }
  }
}

AoSettings settings_of(const char* method, int samples) {
  proto::RenderSettings message;
  message.mutable_ao()->set_method(method);
  message.mutable_ao()->set_samples(samples);
  auto settings = read_settings(message);
  LFD_CHECK(settings, settings.error().message());
  return settings->ao;
}

using Numbers = std::multiset<std::tuple<float, float, float, float>>;
Numbers numbers_of(const std::vector<glm::vec4>& samples) {
  Numbers all;
  for (const glm::vec4& s : samples) all.insert({s.x, s.y, s.z, s.w});
  return all;
}

TEST(DealtSamples, AreTogetherOneSetOfTheGenerator) {
  for (const char* method : {"march", "sphere", "unreal"}) {
    for (const int samples : {4, 6, 28}) {
      AoSettings whole = settings_of(method, samples);
      const auto dealt = dealt_samples(whole, 9);
      ASSERT_EQ(dealt.size(), static_cast<std::size_t>(9 * samples));
      whole.samples *= 9;
      EXPECT_EQ(numbers_of(dealt), numbers_of(whole.sample_set())) << method << " " << samples;
    }
  }
}

TEST(DealtSamples, FitIntoTheShadersTable) {
  EXPECT_EQ(dealt_samples(settings_of("march", 64), 17).size(), 256U);
  EXPECT_EQ(dealt_samples(settings_of("march", 100), 9).size(), 200U);
  EXPECT_EQ(dealt_samples(settings_of("march", 256), 17).size(), 256U);
  EXPECT_EQ(dealt_samples(settings_of("march", 1), 17).size(), 17U);
  const AoSettings many = settings_of("march", 100);
  const auto params = sharing_params(share_among(display_of(9), numbers(9), std::vector<bool>(9, true), 4), many);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(params[static_cast<std::size_t>(i)].window.z, i % 2 * 100) << "two parts fit";
}

TEST(DealtSamples, KeepPairsTogether) {
  AoSettings symmetric = settings_of("sphere", 8);
  symmetric.parameter("symmetric") = 1;
  const auto dealt = dealt_samples(symmetric, 9);
  for (std::size_t i = 0; i < dealt.size(); i += 2) EXPECT_EQ(glm::vec3(dealt[i]), -glm::vec3(dealt[i + 1]));
}

// A method without a set of samples differs by its noise, in each number by equal steps.
TEST(SharingParams, TurnsAreEvenlySpreadOverTheParts) {
  const AoSettings ao = settings_of("gtao", 0);
  for (const int each_side : {1, 3, 8}) {
    const auto count = static_cast<std::uint32_t>(2 * each_side + 1);
    const auto params = sharing_params(
        share_among(display_of(static_cast<int>(count)), numbers(count), std::vector<bool>(count, true), each_side),
        ao);
    for (int c = 0; c < 3; ++c) {
      std::vector<float> turns;
      for (std::size_t i = 0; i < count; ++i) turns.push_back(params[i].turn[c]);
      std::ranges::sort(turns);
      for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(turns[i], static_cast<double>(i) / count, 1e-6);
    }
  }
}

TEST(SharingParams, OnesWithASetTurnAlike) {
  const auto params =
      sharing_params(share_among(display_of(9), numbers(9), std::vector<bool>(9, true), 4), settings_of("march", 4));
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(params[i].turn, params[0].turn);
    EXPECT_EQ(params[i].window.z, 4 * static_cast<float>(i));
  }
}

// Nearer than a run to the world's origin, and a whole number of runs away from the centre.
TEST(NoiseOrigin, IsTheRegionsCentreButForWholeRuns) {
  const DisplayCalibration display = display_of(4);
  RegionOfInterest roi;
  const glm::vec4 at_home = noise_origin(roi, display);
  EXPECT_EQ(glm::vec3(at_home), glm::vec3(0));
  const double pixel_m = 1.59 / 1024;
  EXPECT_GE(std::ldexp(1.0, static_cast<int>(at_home.w)), 128 * pixel_m);
  EXPECT_LE(std::ldexp(1.0, static_cast<int>(at_home.w)), 256 * pixel_m);
  roi.world_centre = {123456.75, -9876.5, 1e6};
  const glm::vec4 far_away = noise_origin(roi, display);
  EXPECT_EQ(far_away.w, at_home.w);
  const double run_m = std::ldexp(1.0, static_cast<int>(far_away.w));
  for (int c = 0; c < 3; ++c) {
    EXPECT_GE(far_away[c], 0);
    EXPECT_LE(far_away[c], run_m);
  }
  // A world ten times as large has pixels ten times as large.
  roi.world_size *= 10;
  EXPECT_NEAR(noise_origin(roi, display).w, at_home.w + std::log2(10.0), 1);
}

}  // namespace
}  // namespace lfd
