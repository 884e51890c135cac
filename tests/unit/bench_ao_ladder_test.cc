// The rungs that are compared: every method, the set-ups of the papers, and what a pixel costs.
#include "bench/ao/ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/log.h"

namespace lfd::bench {
namespace {

RenderSettings settings_of(const Rung& rung) {
  proto::RenderSettings message;
  *message.mutable_ao() = rung.settings;
  auto settings = read_settings(message);
  LFD_CHECK(settings, rung.method() + ", " + rung.name + ": " + settings.error().message());
  return *settings;
}

const Rung& find(const std::vector<Rung>& rungs, const std::string& method, const std::string& name) {
  const auto found =
      std::ranges::find_if(rungs, [&](const Rung& rung) { return rung.method() == method && rung.name == name; });
  LFD_CHECK(found != rungs.end(), method + ", " + name);
  return *found;
}

TEST(AoLadder, HasEveryMethodAsItComes) {
  const auto rungs = ladder({});
  for (const occlusion::Method* method : occlusion::methods()) {
    const auto count = std::ranges::count_if(
        rungs, [&](const Rung& rung) { return rung.is_default && rung.method() == method->name; });
    EXPECT_EQ(count, 1) << method->name;
  }
}

TEST(AoLadder, EverySettingIsPossibleAndNamedOnce) {
  std::set<std::string> names;
  for (const Rung& rung : ladder({})) {
    settings_of(rung);
    EXPECT_TRUE(names.insert(rung.method() + ", " + rung.name).second) << rung.method() << ", " << rung.name;
  }
}

TEST(AoLadder, TakesOnlyTheMethodsAskedFor) {
  for (const Rung& rung : ladder({"schmitt", "gtao"}))
    EXPECT_TRUE(rung.method() == "schmitt" || rung.method() == "gtao") << rung.method();
}

// Pyramid HBAO, table 1, and Aalund 2013, tables 2 to 4, typed from the papers once more.
TEST(AoLadder, HasTheSetUpsOfThePapers) {
  const auto rungs = ladder({});
  for (const auto& [directions, steps] : {std::pair{8, 10}, {16, 20}, {32, 40}, {64, 80}}) {
    const AoSettings ao =
        settings_of(find(rungs, "hbao", fmt::format("{} directions, {} steps", directions, steps))).ao;
    EXPECT_EQ(ao.parameter("directions"), directions);
    EXPECT_EQ(ao.parameter("steps"), steps);
  }
  for (int levels = 1; levels <= 5; ++levels) {
    const std::string name = fmt::format("{} level{}", levels, levels == 1 ? "" : "s");
    const AoSettings pyramid = settings_of(find(rungs, "pyramid_hbao", name)).ao;
    EXPECT_EQ(pyramid.parameter("levels"), levels);
    EXPECT_EQ(pyramid.parameter("directions"), 8);
    const AoSettings scalable = settings_of(find(rungs, "scalable", name)).ao;
    EXPECT_EQ(scalable.parameter("levels"), levels);
    EXPECT_EQ(taps_of(scalable).samples, taps_of(pyramid).samples) << "the same number of samples, as the table has it";
  }
  struct SetUp {
    const char* method;
    const char* fast;
    int taps;
    const char* fine;
    occlusion::Curve fine_curve;
  };
  for (const SetUp& wanted : {SetUp{"crytek", "24 samples", 3, "200 samples", {0.55, 1, 4}},
                              {"starcraft", "15 samples", 2, "80 samples", {0, 1.1, 2}},
                              {"hbao", "8 directions, 6 steps", 1, "80 directions, 6 steps", {0, 1, 3}},
                              {"volumetric", "24 samples", 1, "40 samples", {0.5, 1, 3}},
                              {"alchemy", "6 samples", 2, "64 samples", {0, 1, 5}},
                              {"unreal", "6 samples", 2, "32 samples", {0, 1, 3}}}) {
    const auto of = [&](const char* name) {
      return settings_of(find(rungs, wanted.method, std::string(name) + ", as in 2013")).ao;
    };
    EXPECT_EQ(of(wanted.fast).blur, AoBlur::kGeometry) << wanted.method;
    EXPECT_EQ(of(wanted.fast).blur_taps, wanted.taps) << wanted.method;
    EXPECT_EQ(of(wanted.fast).curve, occlusion::find_method(wanted.method)->curve) << wanted.method;
    EXPECT_FALSE(of(wanted.fine).blur_enabled) << wanted.method;
    EXPECT_EQ(of(wanted.fine).curve, wanted.fine_curve) << wanted.method;
  }
}

TEST(AoLadder, CountsTaps) {
  const auto rungs = ladder({});
  const auto taps = [&](const char* method, const char* name) {
    return taps_of(settings_of(find(rungs, method, name)).ao);
  };
  EXPECT_EQ(taps("hbao", "8 directions, 10 steps").samples, 80);
  EXPECT_EQ(taps("hbao", "8 directions, 10 steps").fetches, 82) << "position and normal of the pixel too";
  EXPECT_EQ(taps("gtao", "3 slices, 6 steps").samples, 36);
  EXPECT_EQ(taps("march", "4 directions, 4 steps").samples, 16);
  EXPECT_EQ(taps("march", "4 directions, 4 steps").fetches, 66) << "four of each point";
  EXPECT_EQ(taps("sphere", "8 samples").fetches, 33);
  EXPECT_EQ(taps("sphere", "8 samples, 5 radii").samples, 40);
  EXPECT_EQ(taps("volumetric", "8 samples").fetches, 33) << "on surfaces too";
  EXPECT_EQ(taps("sphere", "default, half resolution").samples, 2);
  EXPECT_EQ(taps("march", "4 directions, 4 steps, shared over +-4").fetches, 66 + 3 + 8 * 3);
  EXPECT_EQ(taps("pyramid_hbao", "2 levels").samples, 64);
  EXPECT_EQ(taps("schmitt", "8 neighbours").fetches, 18);
}

TEST(AoLadder, NamesBlurs) {
  AoSettings ao;
  EXPECT_EQ(blur_name(ao), "gaussian 1.5 px");
  ao.blur = AoBlur::kGeometry;
  EXPECT_EQ(blur_name(ao), "geometry 2 taps");
  ao.blur_enabled = false;
  EXPECT_EQ(blur_name(ao), "none");
}

}  // namespace
}  // namespace lfd::bench
