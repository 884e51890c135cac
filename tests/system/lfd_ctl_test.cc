// lfd ctl against a running cluster: what it prints, and what it changes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <thread>

#include "base/log.h"
#include "proto/frame_files.h"
#include "proto/pictures/png.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::MatchesRegex;
using testing::StartsWith;

const std::string kQuick = "pacing { heartbeat_ms: 100 }";

// What `lfd ctl` prints.
std::vector<std::string> ctl(const Running& running, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"ctl", "--controller", running.endpoint});
  const auto lfd = start_program("lfd", arguments);
  const auto exit = lfd->wait(kClusterPatience);
  EXPECT_TRUE(exit && exit->succeeded()) << testing::PrintToString(arguments) << testing::PrintToString(lfd->lines());
  return lfd->lines();
}

// The status, once all nodes hold the controller's state.
proto::Status settled_status(const Running& running) {
  EXPECT_TRUE(becomes(running.endpoint, all_nodes_follow));
  const Result<proto::Status> status = status_at(running.endpoint);
  EXPECT_TRUE(status);
  return status ? *status : proto::Status();
}

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

// The picture of module 1 that its node writes for a frame, as soon as it is there.
std::optional<Picture8> written_picture(const Workbench& bench, std::uint64_t frame) {
  const auto path = image_path(bench.folder() / "frames", frame, 1, proto::COLOR);
  const auto deadline = Clock::now() + kClusterPatience;
  while (!std::filesystem::exists(path) && Clock::now() < deadline) std::this_thread::sleep_for(50ms);
  const Result<Picture8> picture = read_png(path);
  EXPECT_TRUE(picture) << (picture ? "" : picture.error().message());
  return picture ? std::optional(*picture) : std::nullopt;
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
  const auto plane = written_picture(bench, before.frame()), first = written_picture(bench, later),
             second = written_picture(bench, later + 1);
  ASSERT_TRUE(plane && first && second);
  EXPECT_FALSE(*plane == *first);
  EXPECT_TRUE(*first == *second) << "nothing else changes the picture";
}

}  // namespace
}  // namespace lfd::harness
