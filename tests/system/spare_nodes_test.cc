// Spare nodes: the modules of a node that dies are drawn by a spare, with the same pictures, and given back by policy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "base/log.h"
#include "tests/system/fault_stage.h"

namespace lfd::harness {
namespace {

using testing::ElementsAre;

constexpr auto kLimit = std::chrono::milliseconds(600);  // of silence, as FaultStage's pacing has it
constexpr auto kFirstPicture = std::chrono::seconds(3);

std::vector<std::uint32_t> modules_of(const FaultStage& stage, const std::string& name) {
  const auto status = status_at(stage.endpoint());
  EXPECT_TRUE(status);
  if (!status) return {};
  const proto::PeerStatus peer = peer_in(*status, name);
  return {peer.module().begin(), peer.module().end()};
}

std::map<int, std::string> start_all(FaultStage& stage) {
  for (const char* const name : {"controller", "display", "reserve", "left", "right"}) stage.start(name);
  EXPECT_TRUE(stage.is_whole());
  EXPECT_THAT(modules_of(stage, "reserve"), ElementsAre());
  return stage.pictures_from(stage.last_frame());
}

TEST(SpareNodes, TakeOverWithTheSamePicturesAndGiveBack) {
  FaultStage stage("node { name: \"reserve\" spare: true }");
  const auto before = start_all(stage);
  const auto killed = Clock::now();
  stage.kill("right");
  ASSERT_TRUE(becomes(stage.endpoint(),
                      [](const proto::Status& status) { return peer_in(status, "reserve").module_size() == 2; }));
  // It is told at the limit of silence; another such time is for a busy machine and the looking.
  EXPECT_LT(Clock::now() - killed, 2 * kLimit);
  ASSERT_TRUE(stage.is_whole_by_spare());
  // Its assets are here; a context and a first picture take tenths of a second. Less than what waiting for a peer that
  // is silent would add.
  EXPECT_LT(Clock::now() - killed, 2 * kLimit + kFirstPicture);
  EXPECT_THAT(modules_of(stage, "reserve"), ElementsAre(2, 3));
  EXPECT_EQ(stage.pictures_from(stage.last_frame()), before);
  EXPECT_EQ(lines_with(stage["controller"], "\"reserve\" takes over modules 2-3 of \"right\""), 1);

  const std::ptrdiff_t late_before = lines_with(stage["controller"], FaultStage::kLate);
  // Mesa compiles all shaders in its first picture, and takes longer over it than a frame may.
  stage.start("right", {{"MESA_SHADER_CACHE_DISABLE", "true"}});
  ASSERT_TRUE(stage.is_whole());
  EXPECT_EQ(stage.pictures_from(stage.last_frame()), before);
  EXPECT_EQ(lines_with(stage["controller"], FaultStage::kLate), late_before) << "giving back costs no frame";
  const auto status = status_at(stage.endpoint());
  ASSERT_TRUE(status);
  EXPECT_TRUE(peer_in(*status, "reserve").spare());
  EXPECT_EQ(peer_in(*status, "reserve").module_size(), 0) << "it draws them no longer";
  EXPECT_TRUE(stage.frames_went_on());
}

TEST(SpareNodes, KeepWhatTheyTookOverWherePolicySaysSo) {
  FaultStage stage("node { name: \"reserve\" spare: true } give_back: NEVER");
  const auto before = start_all(stage);
  stage.kill("right");
  ASSERT_TRUE(stage.is_whole_by_spare());
  stage.start("right");
  ASSERT_TRUE(stage.is_whole());
  // Now right's own end costs nothing, and the spare's end is made good by right.
  stage.kill("right");
  ASSERT_TRUE(stage.is_whole_by_spare());
  stage.start("right");
  ASSERT_TRUE(stage.is_whole());
  stage.kill("reserve");
  ASSERT_TRUE(becomes(stage.endpoint(), [](const proto::Status& status) {
    return peer_in(status, "reserve").state() == "out" && status.stale_modules() == 0;
  }));
  EXPECT_EQ(stage.pictures_from(stage.last_frame() + 2), before);
}

// It loses its GL context in the picture that it draws for nobody: it draws another, and takes its modules back then.
TEST(SpareNodes, DrawUntilANodeHasDrawnAFirstPicture) {
  FaultStage stage("node { name: \"reserve\" spare: true }");
  const auto before = start_all(stage);
  stage.kill("right");
  ASSERT_TRUE(stage.is_whole_by_spare());
  const std::ptrdiff_t late_before = lines_with(stage["controller"], FaultStage::kLate);
  stage.start("right", {{"LFD_FAULTS", "lose-context@drawing:0"}});
  ASSERT_TRUE(stage.is_whole());
  EXPECT_TRUE(says(stage["right"], "a first picture cannot be drawn; until one can, this node takes no part: "));
  EXPECT_EQ(lines_with(stage["controller"], FaultStage::kLate), late_before);
  EXPECT_EQ(stage.pictures_from(stage.last_frame()), before);
}

// A node that is configured and never comes has its modules drawn too.
TEST(SpareNodes, StandInForANodeThatNeverComes) {
  FaultStage stage("node { name: \"reserve\" spare: true }");
  for (const char* const name : {"controller", "display", "reserve", "left"}) stage.start(name);
  ASSERT_TRUE(becomes(stage.endpoint(), [](const proto::Status& status) {
    return peer_in(status, "right").state() == "absent" && status.frame() > 3 && status.stale_modules() == 0;
  }));
  EXPECT_THAT(modules_of(stage, "reserve"), ElementsAre(2, 3));
}

}  // namespace
}  // namespace lfd::harness
