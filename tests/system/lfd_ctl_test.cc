// lfd ctl against a running cluster: what it prints, and what it changes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::MatchesRegex;
using testing::StartsWith;

const std::string kQuick = "pacing { heartbeat_ms: 100 }";

TEST(LfdCtl, StatusShowsWhatIsShownAndWhoTakesPart) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment(kQuick));
  ASSERT_TRUE(draws(running.endpoint, 1));
  ASSERT_TRUE(becomes(running.endpoint, [](const auto& s) { return peer_in(s, "display").state() == "ready"; }));
  const proto::Status status = settled_status(running);
  const std::vector<std::string> table = ctl(running, {"status"});
  EXPECT_THAT(table, Contains(MatchesRegex("deployment +wall")));
  EXPECT_THAT(table, Contains(MatchesRegex("scene +plane")));
  EXPECT_THAT(table, Contains(MatchesRegex("frame +[1-9][0-9]*")));
  EXPECT_THAT(table, Contains(MatchesRegex("stale modules +0")));
  EXPECT_THAT(table, Contains(AllOf(StartsWith("state "), HasSubstr(status.state_hash()),
                                    HasSubstr(fmt::format("(update {})", status.sequence())))));
  for (const auto& [name, modules] : {std::pair("left", "0-1"), std::pair("right", "2-3")}) {
    const std::string row =
        fmt::format("{} +node +ready +{} +{} +{}", name, peer_in(status, name).process(), status.state_hash(), modules);
    EXPECT_THAT(table, Contains(MatchesRegex(row)));
  }
  EXPECT_THAT(table, Contains(MatchesRegex("display +display +ready +[0-9]+ *")));
}

TEST(LfdCtl, RoiPrintsBothBoxesAndChangesThem) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment(kQuick));
  ASSERT_TRUE(draws(running.endpoint, 1));
  const proto::Status before = settled_status(running);
  const std::vector<std::string> whole = ctl(running, {"roi"});
  EXPECT_THAT(ctl(running, {"roi", "0.1,0,0,2,1,1"}), IsEmpty());
  const proto::Status after = settled_status(running);
  EXPECT_EQ(after.roi().world_centre().x(), 0.1);
  EXPECT_EQ(after.roi().world_size().x(), 2);
  EXPECT_GT(after.sequence(), before.sequence());
  EXPECT_NE(after.state_hash(), before.state_hash());
  // The screen is 1.6 m wide: 0.8 of the box's width; by its height 0.9 would do.
  const std::vector<std::string> boxes{"world     centre 0.1, 0, 0  size 2, 1, 1",
                                       "physical  centre 0, 0, 0  size 1.6, 0.8, 0.8"};
  EXPECT_NE(whole, boxes);
  EXPECT_EQ(ctl(running, {"roi"}), boxes);
  EXPECT_THAT(ctl(running, {"status"}), IsSupersetOf(boxes));
  EXPECT_EQ(settled_status(running).sequence(), after.sequence()) << "to print changes nothing";
  EXPECT_THAT(ctl(running, {"roi", "--whole"}), IsEmpty());
  EXPECT_EQ(ctl(running, {"roi"}), whole);
}

TEST(LfdCtl, StatusTellsWhetherThereIsOcclusion) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment(kQuick));
  ASSERT_TRUE(draws(running.endpoint, 1));
  EXPECT_THAT(ctl(running, {"status"}), Contains(MatchesRegex("occlusion +on")));
  const proto::Status before = settled_status(running);
  EXPECT_THAT(ctl(running, {"ao", "--off"}), IsEmpty());
  EXPECT_THAT(ctl(running, {"status"}), Contains(MatchesRegex("occlusion +off")));
  EXPECT_THAT(ctl(running, {"ao"}), Contains(MatchesRegex("occlusion +off")));
  const proto::Status after = settled_status(running);
  EXPECT_GT(after.sequence(), before.sequence());
  EXPECT_NE(after.state_hash(), before.state_hash());
  EXPECT_THAT(ctl(running, {"ao", "--on"}), IsEmpty());
  EXPECT_THAT(ctl(running, {"status"}), Contains(MatchesRegex("occlusion +on")));
}

TEST(LfdCtl, ChangesOnlyWhatIsGiven) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment(kQuick));
  ASSERT_TRUE(draws(running.endpoint, 1));
  const auto change = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "ao");
    ctl(running, arguments);
    return settled_status(running).render().ao();
  };
  proto::AmbientOcclusion ao = change({"--samples", "4"});
  EXPECT_EQ(ao.samples(), 4);
  EXPECT_FALSE(ao.has_enabled());
  EXPECT_FALSE(ao.blur().has_enabled());
  ao = change({"--off", "--set", "symmetric=1", "--no-blur"});
  EXPECT_TRUE(ao.has_enabled() && !ao.enabled());
  ao = change({"--samples", "2"});
  EXPECT_TRUE(ao.has_enabled() && !ao.enabled());
  EXPECT_EQ(ao.parameter().at("symmetric"), 1);
  EXPECT_TRUE(ao.blur().has_enabled() && !ao.blur().enabled());
}

// What `lfd ctl` says instead of a table, and its exit code.
std::vector<std::string> refused(const Running& running, std::vector<std::string> arguments, int code) {
  arguments.insert(arguments.begin(), {"ctl", "--controller", running.endpoint});
  const auto lfd = start_program("lfd", arguments);
  const auto exit = lfd->wait(kClusterPatience);
  EXPECT_TRUE(exit && exit->code == code) << testing::PrintToString(arguments) << testing::PrintToString(lfd->lines());
  EXPECT_EQ(lines_with(*lfd, "error: "), 1) << testing::PrintToString(lfd->lines());
  return lfd->lines();
}

TEST(LfdCtl, ErrorsNameTheOptionAndWhatIsPossible) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment("sink: NONE pacing { heartbeat_ms: 100 }"));
  ASSERT_TRUE(draws(running.endpoint, 1));
  EXPECT_THAT(refused(running, {"ao", "--set", "directions=abc"}, 2),
              Contains(StartsWith("error: --set: directions=abc: a number is needed, 1 to 128 for ")));
  for (const char* const seed : {"-1", "4294967296", "99999999999999999999", "1.5"}) {
    EXPECT_THAT(refused(running, {"ao", "--seed", seed}, 2),
                Contains(fmt::format("error: --seed: {}; whole numbers from 0 to 4294967295 are possible", seed)));
  }
  EXPECT_THAT(refused(running, {"scene", ""}, 2), Contains(StartsWith("error: FILE: the name is empty")));
  ctl(running, {"ao", "--neighbours", "1", "--open-air"});
  EXPECT_THAT(refused(running, {"ao", "--neighbours", "0"}, 1), Contains(HasSubstr("--no-open-air switches it off")));
  EXPECT_THAT(ctl(running, {"ao", "--neighbours", "0", "--no-open-air"}), IsEmpty());
}

TEST(LfdCtl, WarnsOfSettingsWithoutEffect) {
  const Workbench bench;
  const Running running = run_cluster(bench.deployment(
      "sink: NONE pacing { heartbeat_ms: 100 } render { ao { method: \"gtao\" radius_m: 0.1 radius_roi: 0.1 } }"));
  EXPECT_TRUE(says(*running.lfd, "render: ao.radius_roi: has no effect beside ao.radius_m"));
  ASSERT_TRUE(draws(running.endpoint, 1));
  EXPECT_THAT(ctl(running, {"ao", "--samples", "4"}), Contains("warning: ao.samples: has no effect: gtao takes none"));
}

TEST(LfdCtl, SceneChangesThePicturesOfLaterFrames) {
  const Workbench bench;
  const std::string room = bench.folder() / "room.glb";
  const auto made = start_program("lfd-scene", {"make", "room", "--out", room})->wait(kClusterPatience);
  ASSERT_TRUE(made && made->succeeded());
  const Running running =
      run_cluster(bench.deployment("sink: FILES files: \"frames\" pacing { heartbeat_ms: 100 frames_per_second: 10 }"));
  ASSERT_TRUE(draws(running.endpoint, 1));
  const proto::Status before = settled_status(running);
  EXPECT_EQ(before.scene(), "plane");
  ctl(running, {"scene", room});
  const proto::Status after = settled_status(running);
  EXPECT_EQ(after.scene(), "room");
  EXPECT_GT(after.sequence(), before.sequence());
  EXPECT_NE(after.state_hash(), before.state_hash());
  EXPECT_THAT(ctl(running, {"status"}), Contains(MatchesRegex("scene +room")));
  // Two frames may be open at a time: the third one to come begins with the new scene.
  const std::uint64_t later = after.frame() + 3;
  const auto frames = bench.folder() / "frames";
  const auto plane = written_picture(frames, before.frame(), 1), first = written_picture(frames, later, 1),
             second = written_picture(frames, later + 1, 1);
  ASSERT_TRUE(plane && first && second);
  EXPECT_FALSE(*plane == *first);
  EXPECT_TRUE(*first == *second) << "nothing else changes the picture";
}

}  // namespace
}  // namespace lfd::harness
