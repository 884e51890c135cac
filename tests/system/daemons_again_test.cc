// The display and the controller killed, stopped and started again beside everything else that stays: frames come back,
// with the same pictures. A display that cannot write goes on too.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/log.h"
#include "controller/scene/made/made_scenes.h"
#include "controller/scene/scene_file.h"
#include "tests/system/fault_stage.h"

namespace lfd::harness {
namespace {

namespace fs = std::filesystem;

class DaemonsAgain : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* const name : {"controller", "display", "left", "right"}) stage_.start(name);
    ASSERT_TRUE(stage_.is_whole());
    before_ = stage_.pictures_from(stage_.last_frame());
  }

  // Nobody but these has been started again.
  void expect_lives(std::initializer_list<const char*> names) {
    for (const char* const name : names) EXPECT_FALSE(stage_[name].poll()) << name;
  }

  // The display goes on writing meanwhile.
  void remove_shown() {
    std::error_code failure;
    do {
      failure.clear();
      fs::remove_all(stage_.shown(), failure);
    } while (failure);
  }

  FaultStage stage_{""};
  std::map<int, std::string> before_;
};

TEST_F(DaemonsAgain, AKilledDisplayIsReplacedAndShowsTheSame) {
  stage_.kill("display");
  const std::uint64_t killed = stage_.last_frame();
  stage_.start("display");
  ASSERT_TRUE(stage_.shows_frames_after(killed + 3));
  ASSERT_TRUE(stage_.is_whole());
  EXPECT_EQ(stage_.pictures_from(stage_.last_frame()), before_);
  expect_lives({"controller", "left", "right"});
}

TEST_F(DaemonsAgain, AStoppedDisplayCostsFramesAndShowsAgain) {
  stage_["display"].signal(SIGSTOP);
  ASSERT_TRUE(becomes(stage_.endpoint(),
                      [](const proto::Status& status) { return peer_in(status, "display").state() == "out"; }));
  const std::uint64_t stopped = stage_.last_frame();
  stage_["display"].signal(SIGCONT);
  ASSERT_TRUE(stage_.shows_frames_after(stopped + 3));
  ASSERT_TRUE(stage_.is_whole());
  EXPECT_EQ(stage_.pictures_from(stage_.last_frame()), before_);
  expect_lives({"controller", "left", "right"});
}

TEST_F(DaemonsAgain, AKilledControllerIsJoinedAgainByEverybody) {
  stage_.kill("controller");
  fs::remove_all(stage_.shown());  // frames count anew
  stage_.start("controller");
  ASSERT_TRUE(stage_.is_whole());
  EXPECT_EQ(stage_.pictures_from(stage_.last_frame()), before_);
  expect_lives({"display", "left", "right"});
}

TEST_F(DaemonsAgain, AControllerThatIsStoppedForLongGoesOnWithEverybody) {
  stage_["controller"].signal(SIGSTOP);
  ASSERT_TRUE(says(stage_["left"], "nothing heard of the controller"));
  ASSERT_TRUE(says(stage_["right"], "nothing heard of the controller"));
  ASSERT_TRUE(says(stage_["display"], "nothing heard of the controller"));
  stage_["controller"].signal(SIGCONT);
  const std::uint64_t again = stage_.last_frame();
  ASSERT_TRUE(stage_.is_whole());
  EXPECT_EQ(stage_.pictures_from(again + 3), before_);
  expect_lives({"display", "left", "right"});
}

TEST_F(DaemonsAgain, AFolderThatGoesAwayCostsPicturesOnly) {
  remove_shown();
  const std::uint64_t gone = stage_.last_frame();
  ASSERT_TRUE(stage_.shows_frames_after(gone + 3)) << "it is made again";
  // A file in its place: nothing can be written there.
  const fs::path aside = stage_.shown().string() + "-aside";
  while (fs::exists(stage_.shown())) {
    std::error_code busy;
    fs::rename(stage_.shown(), aside, busy);
    if (!busy) break;
  }
  { std::ofstream(stage_.shown()) << "in the way"; }
  const bool blocked = fs::is_regular_file(stage_.shown());
  const std::uint64_t blocked_at = stage_.last_frame();
  ASSERT_TRUE(becomes(stage_.endpoint(), [&](const proto::Status& status) {
    return status.frame() > blocked_at + 5 && status.stale_modules() == 0;
  }));
  if (!blocked) GTEST_SKIP() << "the display was quicker than the test in making its folder anew";
  const std::string told = "Not a directory; frames go on, further pictures that fail for this reason are only counted";
  ASSERT_TRUE(says(stage_["display"], told));
  // Of many pictures. What the display had in hand while its folder went away fails in other ways, each said likewise.
  EXPECT_EQ(lines_with(stage_["display"], told), 1);
  fs::remove(stage_.shown());
  ASSERT_TRUE(stage_.is_whole());
  EXPECT_EQ(stage_.pictures_from(stage_.last_frame()), before_);
}

TEST_F(DaemonsAgain, AFullDiskCostsPicturesOnly) {
  remove_shown();
  fs::create_directories(stage_.shown());
  if (::mount("lfd-test", stage_.shown().c_str(), "tmpfs", 0, "size=256k") != 0)
    GTEST_SKIP() << "a small file system cannot be mounted here (needs root)";
  const std::uint64_t full = stage_.last_frame();
  const bool told = says(stage_["display"], "No space left on device");
  const auto goes_on = becomes(stage_.endpoint(), [&](const proto::Status& status) {
    return status.frame() > full + 20 && status.stale_modules() == 0;
  });
  const std::ptrdiff_t times = lines_with(stage_["display"], "No space left on device");
  ::umount2(stage_.shown().c_str(), MNT_DETACH);
  EXPECT_TRUE(told);
  EXPECT_TRUE(goes_on);
  EXPECT_LE(times, 4) << "of many pictures that failed";
  ASSERT_TRUE(stage_.is_whole());
  EXPECT_EQ(stage_.pictures_from(stage_.last_frame()), before_);
}

// Who waits for an answer of a controller that was killed hears that it has gone, though another is there by then.
TEST_F(DaemonsAgain, AControllerThatGoesLeavesNobodyWaitingForItsAnswer) {
  const fs::path scene = stage_.deployment().parent_path() / "room.glb";
  ASSERT_TRUE(scene::write_glb(scene, scene::make_scene("room", 1)->data));
  for (const char* const name : {"left", "right"}) stage_[name].signal(SIGSTOP);  // they prepare nothing
  const auto ctl = start_program("lfd", {"ctl", "--controller", stage_.endpoint(), "scene", scene.string()});
  ASSERT_TRUE(says(stage_["controller"], "2 nodes prepare it"));
  stage_.start("controller");
  const auto exit = ctl->wait(kClusterPatience);  // a scene may take ten minutes
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->code, 1);
  EXPECT_EQ(lines_with(*ctl, "has gone before it answered"), 1);
  for (const char* const name : {"left", "right"}) stage_[name].signal(SIGCONT);
  EXPECT_TRUE(stage_.is_whole());
}

}  // namespace
}  // namespace lfd::harness
