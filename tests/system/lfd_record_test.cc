// lfd record and lfd replay with real processes: a show that moves and is changed while it runs is drawn again, byte by
// byte, by other nodes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/log.h"
#include "proto/calibration_file.h"
#include "proto/frame_files.h"
#include "proto/settings.h"
#include "tests/harness/played_node.h"
#include "tests/support/made.h"
#include "tests/support/recorded_show.h"
#include "tests/system/running_cluster.h"
#include "tests/unit/gltf_maker.h"

namespace lfd::harness {
namespace {

namespace fs = std::filesystem;
using test::GltfMaker;
using testing::Contains;
using testing::HasSubstr;
using testing_support::made_data;
using testing_support::RecordedShow;
using testing_support::unwrapped;

constexpr ImageSize kImage{64, 36};
constexpr std::uint32_t kModules = 4;
constexpr const char* kNodes[] = {"node { name: \"only\" }",
                                  "node { name: \"a\" } node { name: \"b\" } node { name: \"c\" }"};

// A triangle before a larger one, which moves on by pixels from frame to frame.
std::string moving_gltf() {
  GltfMaker maker = GltfMaker::triangle();
  std::vector<float> times, places;
  for (int i = 0; i <= 30; ++i) {
    times.push_back(static_cast<float>(i));
    places.insert(places.end(), {0.1F * static_cast<float>(i % 7), 0.05F * static_cast<float>(i % 5), 0.1F});
  }
  maker.animate("translation", "LINEAR", times, places);
  return maker.gltf();
}

std::string deployment_of(const std::string& scene, const std::string& nodes, const std::string& more) {
  return fmt::format("name: \"wall\" display: \"display.textproto\" scene {{ {} frames_per_second: 4 }} {} {}", scene,
                     nodes, more);
}

std::string read(const fs::path& path) {
  const auto content = read_file(path);
  return content ? *content : "no file";
}

class Recorder {
 public:
  Recorder(const Running& running, fs::path out, std::vector<std::string> more = {}) : out_(std::move(out)) {
    more.insert(more.begin(), {"record", "--controller", running.endpoint, "--out", out_.string()});
    lfd_ = start_program("lfd", std::move(more));
    EXPECT_TRUE(lfd_->wait_for_line("recording " + out_.string(), kClusterPatience))
        << testing::PrintToString(lfd_->lines());
  }
  Process& process() { return *lfd_; }
  // 0, and it says what it has.
  void ended() {
    const auto exit = lfd_->wait(kClusterPatience);
    ASSERT_TRUE(exit && exit->succeeded()) << testing::PrintToString(lfd_->lines());
    EXPECT_THAT(lfd_->lines(), Contains(HasSubstr(out_.string() + ": ")));
  }

 private:
  fs::path out_;
  std::unique_ptr<Process> lfd_;
};

// The lines of a replay that came to its end.
std::vector<std::string> replayed(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "replay");
  const auto lfd = start_program("lfd", arguments);
  const auto exit = lfd->wait(kClusterPatience);
  EXPECT_TRUE(exit && exit->succeeded()) << testing::PrintToString(lfd->lines());
  return lfd->lines();
}

TEST(LfdRecord, AReplayDrawsTheSamePicturesWithOtherNodes) {
  const Workbench bench(kImage);
  const fs::path show = bench.folder() / "show.lfdrec", cut = bench.folder() / "cut.lfdrec",
                 ended = bench.folder() / "ended.lfdrec", room = bench.folder() / "room.glb",
                 frames = bench.folder() / "frames";
  bench.file("moving.gltf", moving_gltf());
  const auto made = start_program("lfd-scene", {"make", "room", "--out", room})->wait(kClusterPatience);
  ASSERT_TRUE(made && made->succeeded());
  const Running running = run_cluster(bench.file(
      "wall.textproto", deployment_of("file: \"moving.gltf\"", "node { name: \"left\" } node { name: \"right\" }",
                                      "sink: FILES files: \"frames\" "
                                      "pacing { heartbeat_ms: 100 frames_per_second: 20 }")));
  ASSERT_TRUE(draws(running.endpoint, 1));
  {
    Recorder recorder(running, show), killed(running, cut);
    for (const std::vector<std::string>& change :
         std::vector<std::vector<std::string>>{{"roi", "0.4,0.3,0,1.5,1.2,1"},
                                               {"ao", "--samples", "4", "--radius", "0.3"},
                                               {"pattern", "number"},
                                               {"pattern", "off"},
                                               {"scene", room},
                                               {"ao", "--off"}}) {
      ctl(running, change);
      ASSERT_TRUE(draws(running.endpoint, 3));
    }
    killed.process().signal(SIGKILL);
    recorder.process().signal(SIGINT);
    recorder.ended();
  }
  {
    Recorder recorder(running, ended);
    ctl(running, {"quit"});
    recorder.ended();  // the controller says that it ends
  }
  ASSERT_TRUE(running.lfd->wait(kClusterPatience));

  const Recording whole = unwrapped(Recording::open(show)), half = unwrapped(Recording::open(cut));
  EXPECT_EQ(whole.contents().end, "signal 2");
  EXPECT_THAT(half.contents().note, HasSubstr("it was cut off"));
  EXPECT_GT(half.contents().frames, 10U);
  EXPECT_THAT(unwrapped(Recording::open(ended)).contents().end, HasSubstr("a client asked for it"));

  for (const char* const nodes : kNodes) {
    const fs::path other = bench.file("other.textproto", deployment_of("made { name: \"plane\" }", nodes, ""));
    const fs::path out = bench.folder() / "out";
    const auto lines = replayed({show, other, "--as-fast-as-possible", "--out", out});
    EXPECT_THAT(lines, Contains(HasSubstr(fmt::format("{} frames replayed; each of", whole.contents().frames))));
    std::set<std::string> different;
    std::uint32_t compared = 0, absent = 0;
    for (std::uint64_t frame = whole.contents().first_frame; frame <= whole.contents().last_frame; ++frame) {
      for (std::uint32_t module = 0; module < kModules; ++module) {
        const fs::path recorded = image_path(frames, frame, module, proto::COLOR);
        // A frame during which a scene came may have been given up by its nodes, and the last ones by their end.
        if (!fs::exists(recorded)) {
          ++absent;
          continue;
        }
        ++compared;
        different.insert(read(recorded));
        const fs::path again = image_path(out, frame, module, proto::COLOR);
        EXPECT_TRUE(fs::exists(again)) << again;
        EXPECT_TRUE(read(recorded) == read(again)) << again << " of " << nodes;
      }
    }
    EXPECT_GT(compared, 20 * kModules);
    EXPECT_LE(absent, 4 * kModules);
    EXPECT_GT(different.size(), 4 * kModules) << "it was a show";
  }
  EXPECT_THAT(replayed({cut, bench.folder() / "other.textproto", "--speed", "8"}),
              Contains(HasSubstr("the recording is not whole: it was cut off")));
}

// Two frames of a plane, the second a minute after the first.
fs::path slow_show(const Workbench& bench, const std::string& display = "display.textproto") {
  const DisplayCalibration calibration = unwrapped(load_calibration(bench.folder() / display));
  RecordedShow show(calibration);
  const SceneData plane = made_data("plane");
  show.snapshot(testing_support::whole_state(plane, write_roi(testing_support::whole_scene(plane.scene, calibration))));
  show.assets(plane.assets);
  show.frame(3);
  show.now_ns += 60'000'000'000;
  show.frame(4);
  show.end();
  return bench.file("slow.lfdrec", show.bytes);
}

// Nodes that say what they draw, one of them another state than was recorded.
TEST(LfdReplay, FailsWhereANodeDrawsAnotherState) {
  const Workbench bench;
  const auto controller = start_controller(bench.deployment("pacing { heartbeat_ms: 100 } sink: NONE"),
                                           {"--replay", slow_show(bench), "--replay-speed", "0"});
  PlayedNode left("left", controller.endpoint), right("right", controller.endpoint, {.drawn_hash = "another"});
  ASSERT_TRUE(play_until({&left, &right}, [&] { return left.quit; }));
  const auto exit = controller.process->wait(kClusterPatience);
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  EXPECT_THAT(controller.process->lines(), Contains(HasSubstr("error: frame 3: node \"right\" drew state another")));
}

TEST(LfdReplay, ClientsCannotChangeWhatIsReplayed) {
  const Workbench bench;
  const fs::path wall = bench.deployment("pacing { heartbeat_ms: 100 } sink: NONE");
  const auto replay = start_program("lfd", {"replay", slow_show(bench), wall, "--log-level", "debug"});
  ASSERT_TRUE(replay->wait_for_line("frame 3: swap", kClusterPatience)) << testing::PrintToString(replay->lines());
  std::string endpoint;
  for (const std::string& line : replay->lines()) {
    if (const std::size_t at = line.find("control tcp://"); at != std::string::npos) endpoint = line.substr(at + 8);
  }
  for (const std::vector<std::string>& change :
       std::vector<std::vector<std::string>>{{"roi", "--whole"}, {"ao", "--off"}, {"pattern", "number"}}) {
    std::vector<std::string> arguments{"ctl", "--controller", endpoint};
    arguments.insert(arguments.end(), change.begin(), change.end());
    const auto lfd = start_program("lfd", arguments);
    const auto exit = lfd->wait(kClusterPatience);
    ASSERT_TRUE(exit);
    EXPECT_EQ(exit->code, 1);
    EXPECT_THAT(lfd->lines(), Contains("error: a recording is replayed: what it shows cannot be changed"));
  }
  const auto status = status_at(endpoint);
  ASSERT_TRUE(status);
  EXPECT_EQ(status->frame(), 3U) << "the next one is due in a minute";
  replay->signal(SIGTERM);
  const auto exit = replay->wait(kClusterPatience);
  EXPECT_TRUE(exit && exit->code == 1);
}

TEST(LfdReplay, WhatCannotBeReplayedIsRefusedWithTheReason) {
  const Workbench bench;
  const fs::path wall = bench.deployment("sink: NONE");
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "replay");
    const auto lfd = start_program("lfd", arguments);
    const auto exit = lfd->wait(kClusterPatience);
    EXPECT_TRUE(exit && exit->code == 1) << testing::PrintToString(lfd->lines());
    const auto lines = lfd->lines();
    return lines.empty() ? "" : lines.back();
  };
  const fs::path garbage = bench.file("garbage.lfdrec", "lfd recording\n" + std::string(50, 'x'));
  EXPECT_THAT(refused({garbage, wall}),
              HasSubstr(garbage.string() + ": offset 14: a record of 2021161080 bytes; at most"));
  const fs::path show = slow_show(bench);
  EXPECT_THAT(refused({show, wall, "--frames", "7-9"}), HasSubstr("it has frames 3 to 4; none of them is asked for"));
  DisplayCalibration other = unwrapped(load_calibration(bench.folder() / "display.textproto"));
  other.name = "another";
  other.modules[0].emitter.x += 0.01;
  ASSERT_TRUE(save_calibration(bench.folder() / "other.textproto", other));
  const fs::path of_other = slow_show(bench, "other.textproto");
  EXPECT_THAT(refused({of_other, wall}), HasSubstr("it was recorded on display \"another\""));
  EXPECT_THAT(replayed({of_other, wall, "--any-display", "--frames", "4-4"}), Contains(HasSubstr("1 frame replayed")));
}

TEST(LfdRecord, WritesNothingOverAndSaysWhereTheDiskIsFull) {
  const Workbench bench;
  const RunningController controller = start_controller(bench.deployment("pacing { heartbeat_ms: 100 }"));
  const auto refused = [&](const fs::path& out) {
    const auto lfd = start_program("lfd", {"record", "--controller", controller.endpoint, "--out", out});
    const auto exit = lfd->wait(kClusterPatience);
    EXPECT_TRUE(exit && exit->code == 1);
    const auto lines = lfd->lines();
    return lines.empty() ? "" : lines.back();
  };
  const fs::path there = bench.file("there.lfdrec", "a show");
  EXPECT_EQ(refused(there), "error: " + there.string() + ": exists already; it is not overwritten");
  EXPECT_EQ(read(there), "a show");
  if (fs::exists("/dev/full")) {
    EXPECT_THAT(refused("/dev/full"), HasSubstr("No space left on device"));
  }
}

}  // namespace
}  // namespace lfd::harness
