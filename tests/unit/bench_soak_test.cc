// What a soak judges by: frames of one state, colours that cannot be mistaken, faults that the seed decides.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bench/soak/faults.h"
#include "bench/soak/frame_checker.h"
#include "bench/soak/pause_watch.h"
#include "bench/soak/soak_table.h"

namespace lfd::bench {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::EndsWith;
using testing::IsEmpty;

TEST(FrameChecker, NoTwoOfManyColoursAreAlike) {
  std::set<Rgb8> colors;
  for (std::uint64_t n = 0; n < 343; ++n) colors.insert(shown_background_of(n));
  EXPECT_EQ(colors.size(), 343U);
  EXPECT_EQ(shown_background_of(343), shown_background_of(0));
}

constexpr Rgb8 kOneScene{200, 50, 90}, kOtherScene{30, 160, 220};

// Unlit and textured, like what lies behind it, until it is given its colour.
proto::Scene scene_of(const Rgb8& color) {
  proto::Scene scene;
  for (const char* const picture : {"behind", "middle"}) {
    proto::Material& material = *scene.add_material();
    material.mutable_texture()->set_picture(picture);
    material.set_unlit(true);
  }
  give_own_color(scene, color);
  return scene;
}

FrameChecker::Pixels pixels_of(std::uint64_t background, const Rgb8& scene) {
  return {.background = shown_background_of(background), .scene = scene};
}

class Checker : public testing::Test {
 protected:
  void SetUp() override {
    checker_.scene(2, scene_of(kOneScene));
    checker_.background(5, background_of(1));
    checker_.background(8, background_of(2));
    checker_.scene(9, scene_of(kOtherScene));
    checker_.begun(10, 7);
    checker_.begun(11, 8);
    checker_.begun(12, 9);
    checker_.swapped(10, {});
    checker_.swapped(11, {3});
    checker_.swapped(12, {});
  }
  FrameChecker checker_;
};

TEST_F(Checker, AFrameOfItsStateIsRight) {
  const auto verdict = checker_.judge(10, {{0, pixels_of(1, kOneScene)}, {1, pixels_of(1, kOneScene)}});
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->fresh, 2);
  EXPECT_EQ(verdict->wrong, 0);
}

TEST_F(Checker, AModuleOfAnotherStateIsWrongUnlessItIsStale) {
  const auto mixed = checker_.judge(11, {{0, pixels_of(2, kOneScene)}, {1, pixels_of(1, kOneScene)}});
  ASSERT_TRUE(mixed);
  EXPECT_EQ(mixed->wrong, 1);
  const auto stale = checker_.judge(11, {{0, pixels_of(2, kOneScene)}, {3, pixels_of(1, kOneScene)}});
  ASSERT_TRUE(stale);
  EXPECT_EQ(stale->fresh, 1);
  EXPECT_EQ(stale->wrong, 0);
}

TEST_F(Checker, AModuleOfAnotherSceneIsWrongThoughItsBackgroundIsRight) {
  const auto after = checker_.judge(12, {{0, pixels_of(2, kOtherScene)}, {1, pixels_of(2, kOneScene)}});
  ASSERT_TRUE(after);
  EXPECT_EQ(after->wrong, 1) << "the old scene after the change";
  EXPECT_THAT(after->errors,
              ElementsAre("frame 12 of state 9, module 1: background 90 20 20 instead of 90 20 20, scene "
                          "200 50 90 instead of 30 160 220"));
  const auto before = checker_.judge(11, {{0, pixels_of(2, kOneScene)}, {1, pixels_of(2, kOtherScene)}});
  ASSERT_TRUE(before);
  EXPECT_EQ(before->wrong, 1) << "the new scene before the change";
}

TEST_F(Checker, RoundingIsNoOtherColour) {
  FrameChecker::Pixels pixels = pixels_of(2, kOneScene);
  pixels.background[1] += 2;
  pixels.scene[0] += 2;
  EXPECT_EQ(checker_.judge(11, {{0, pixels}})->wrong, 0);
  pixels.background[1] += 8;
  EXPECT_EQ(checker_.judge(11, {{0, pixels}})->wrong, 1);
}

TEST_F(Checker, WhatIsNotKnownIsNotJudged) {
  const FrameChecker::Pixels pixels = pixels_of(2, kOtherScene);
  EXPECT_FALSE(checker_.judge(13, {{0, pixels}}));
  checker_.begun(13, 9);
  EXPECT_FALSE(checker_.judge(13, {{0, pixels}})) << "it has not been swapped";
  checker_.begun(14, 3);
  checker_.swapped(14, {});
  EXPECT_FALSE(checker_.judge(14, {{0, pixels}})) << "nothing was heard of that state";
  checker_.scene(10, proto::Scene());
  checker_.begun(15, 10);
  checker_.swapped(15, {});
  EXPECT_FALSE(checker_.judge(15, {{0, pixels}})) << "that scene has no colour of its own";
  checker_.restarted();
  EXPECT_FALSE(checker_.judge(11, {{0, pixels}}));
  EXPECT_FALSE(checker_.last_swapped());
}

TEST(OwnColor, LeavesNoTextureOrLightToTheLastMaterialAlone) {
  const proto::Scene scene = scene_of(kOneScene);
  EXPECT_TRUE(scene.material(0).has_texture()) << "that one stays as it is";
  EXPECT_TRUE(scene.material(1).unlit());
  EXPECT_FALSE(scene.material(1).has_texture());
  EXPECT_EQ(scene.material(1).base_color_size(), 4);
}

TEST(PauseWatch, CountsTheLongestAndTheOneThatGoesOn) {
  const Clock::time_point start{};
  PauseWatch watch;
  EXPECT_EQ(watch.longest(start + 9s), 0s) << "nothing has been shown yet";
  for (const auto at : {0ms, 50ms, 450ms, 500ms}) watch.swapped(start + at);
  EXPECT_EQ(watch.longest(start + 510ms), 400ms);
  EXPECT_EQ(watch.longest(start + 2500ms), 2s);
  watch.start_anew();
  EXPECT_EQ(watch.longest(start + 510ms), 10ms);
  watch.swapped(start + 800ms);
  EXPECT_EQ(watch.longest(start + 800ms), 300ms) << "it had begun before";
}

TEST(FaultChoice, IsDecidedByTheSeedAndLeavesNoKindOut) {
  FaultChoice one(3), same(3), other(4);
  std::map<Fault, int> seen;
  bool differs = false;
  constexpr int kGentle = 11, kKilling = 5;
  for (int i = 0; i < 3 * kGentle; ++i) {
    const Fault fault = one.next(true);
    EXPECT_EQ(fault, same.next(true));
    differs = differs || fault != other.next(true);
    EXPECT_LT(fault, Fault::kKillSpare);
    ++seen[fault];
  }
  EXPECT_TRUE(differs);
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kGentle));
  for (const auto& [fault, times] : seen) EXPECT_EQ(times, 3) << name_of(fault);
  std::set<Fault> killing;
  for (int i = 0; i < kKilling; ++i) killing.insert(one.next(false));
  EXPECT_EQ(killing, (std::set{Fault::kKillSpare, Fault::kKillNodeAndSpare, Fault::kKillOtherNode, Fault::kKillDisplay,
                               Fault::kKillController}));
}

// A table that breaks no bound, though it is at every one of them.
SoakTable good_table() {
  SoakTable table;
  table.shown_frames = 7;
  table.judged_modules = 56;
  table.stale_frames = table.late_frames = 3;
  for (const Fault fault : {Fault::kKillNode, Fault::kStopController, Fault::kKillController, Fault::kStopDisplay})
    table.outcomes.push_back({fault, kMostRecovery_s, most_pause_s(fault)});
  table.growths = {{"controller", 20, 20 + kMostGrowth_mib, 30, 30}, {"left", 170, 160, 25, 25}};
  return table;
}

std::string last_line(const std::string& text) {
  EXPECT_THAT(text, EndsWith("\n"));
  const std::string lines = text.substr(0, text.size() - 1);
  return lines.substr(lines.rfind('\n') + 1);
}

// Judged: this bound, and no other; said in the last line and by the exit code.
void expect_broken(SoakTable table, const std::string& by) {
  judge(table);
  EXPECT_THAT(table.broken, ElementsAre(by));
  EXPECT_EQ(table.exit_code(), 1);
  EXPECT_EQ(last_line(text_of(table)), "failed: " + by);
}

TEST(SoakVerdict, PassesWhereNoBoundIsBroken) {
  SoakTable table = good_table();
  judge(table);
  EXPECT_THAT(table.broken, IsEmpty());
  EXPECT_EQ(table.exit_code(), 0);
  EXPECT_EQ(last_line(text_of(table)), "passed: 4 faults, 7 frames looked at, none mixed");
}

TEST(SoakVerdict, FailsWithMixedFrames) {
  SoakTable table = good_table();
  table.mixed_frames = 1;
  expect_broken(table, "1 frames are mixed");
}

TEST(SoakVerdict, FailsWhereNothingCouldBeLookedAt) {
  SoakTable table = good_table();
  table.judged_modules = 0;
  expect_broken(table, "no frame could be looked at");
}

TEST(SoakVerdict, FailsWithMemoryThatGrows) {
  SoakTable table = good_table();
  table.growths[0].mib_now += 0.1;
  expect_broken(table, "controller has grown by 8.1 MiB");
}

TEST(SoakVerdict, FailsWithOtherNumbersOfDescriptors) {
  SoakTable more = good_table();
  more.growths[1].descriptors_now = 26;
  expect_broken(more, "left has 26 descriptors open, 25 before");
  SoakTable fewer = good_table();
  fewer.growths[1].descriptors_now = 24;
  expect_broken(fewer, "left has 24 descriptors open, 25 before");
}

TEST(SoakVerdict, FailsWhereNothingWasMeasured) {
  SoakTable table = good_table();
  table.growths.clear();
  expect_broken(table, "memory and descriptors were not measured");
}

TEST(SoakVerdict, FailsWithASlowRecovery) {
  SoakTable table = good_table();
  table.outcomes[0].recovery_s = 20.1;
  expect_broken(table, "node killed: whole again after 20.1 s only");
}

TEST(SoakVerdict, FailsWithAPauseLongerThanItsFaultMayMake) {
  SoakTable table = good_table();
  table.outcomes[0].pause_s = 0.58;
  expect_broken(table, "node killed: no frame for 0.58 s, 0.55 s are allowed");
  for (std::size_t i = 1; i < 4; ++i) {
    SoakTable of_others = good_table();
    of_others.outcomes[i].pause_s += 0.01;
    judge(of_others);
    EXPECT_EQ(of_others.broken.size(), 1U) << name_of(of_others.outcomes[i].fault);
  }
}

TEST(SoakVerdict, IsOneLineOfAllThatWentWrong) {
  SoakTable table;
  table.broken = {"left has ended (signal 11): last\nwords"};
  judge(table);
  EXPECT_EQ(table.exit_code(), 1);
  EXPECT_EQ(last_line(text_of(table)),
            "failed: left has ended (signal 11): last words; no frame could be looked at; memory and descriptors were "
            "not measured");
}

}  // namespace
}  // namespace lfd::bench
