// A node that joins in the middle of ten thousand updates of the state ends with the same state as everyone.
#include <gtest/gtest.h>

#include "base/file.h"
#include "base/log.h"
#include "cli/control_client.h"
#include "proto/frame_files.h"
#include "proto/settings.h"
#include "tests/system/fault_stage.h"

namespace lfd::harness {
namespace {

constexpr int kUpdates = 10'000;
constexpr int kMostUpdates = 10 * kUpdates;  // where the machine is slow to start a node

TEST(LateJoiner, HoldsTheSameStateAfterTenThousandUpdates) {
  FaultStage stage("", FaultStage::kPacing);
  for (const char* const name : {"controller", "display", "left"}) stage.start(name);
  ASSERT_TRUE(becomes(stage.endpoint(), [](const proto::Status& status) {
    return peer_in(status, "left").state() == "ready" && status.frame() > 3;
  }));
  auto client = ControlClient::connect(stage.endpoint());
  ASSERT_TRUE(client);
  std::optional<std::uint64_t> joined_at;
  for (int i = 0; i < kUpdates || (!joined_at && i < kMostUpdates); ++i) {
    if (i == kUpdates / 3) stage.start("right");
    proto::Request request;
    request.mutable_ao()->set_radius_roi(0.01 + 1e-6 * i);
    const auto reply = client->ask(request, kClusterPatience);
    ASSERT_TRUE(reply) << i << ": " << reply.error().message();
    if (i % 100 != 0 || joined_at || i < kUpdates / 3) continue;
    const auto status = status_at(stage.endpoint());
    if (status && peer_in(*status, "right").state() == "ready") joined_at = status->sequence();
  }
  ASSERT_TRUE(stage.is_whole());
  const auto status = status_at(stage.endpoint());
  ASSERT_TRUE(status);
  EXPECT_GE(status->sequence(), std::uint64_t{kUpdates});
  EXPECT_EQ(peer_in(*status, "right").state_hash(), status->state_hash());
  EXPECT_EQ(peer_in(*status, "left").state_hash(), status->state_hash());
  EXPECT_TRUE(joined_at) << "it took part before the last update";
}

// What changed while a node was away is in its pictures when it is back: they are those of a cluster that always had it
// so.
TEST(LateJoiner, DrawsWhatChangedWhileItWasAway) {
  FaultStage stage("");
  for (const char* const name : {"controller", "display", "left", "right"}) stage.start(name);
  ASSERT_TRUE(stage.is_whole());
  const auto old_pictures = stage.pictures_from(stage.last_frame());
  stage.kill("right");
  auto client = ControlClient::connect(stage.endpoint());
  ASSERT_TRUE(client);
  const std::vector<double> box{0.2, 0, 0, 0.7, 0.7, 0.7};
  proto::Request request;
  set_box(*request.mutable_roi()->mutable_world_centre(), *request.mutable_roi()->mutable_world_size(), box);
  ASSERT_TRUE(client->ask(request, kClusterPatience));
  stage.start("right");
  ASSERT_TRUE(stage.is_whole());
  const auto pictures = stage.pictures_from(stage.last_frame());
  EXPECT_NE(pictures, old_pictures);

  const auto reference = stage.deployment().parent_path() / "reference";
  // The addresses of the deployment are wanted.
  for (const char* const name : {"left", "right", "display", "controller"}) stage.kill(name);
  const auto again = start_program("lfd", {"render", stage.deployment(), "--out", reference, "--frames", "1",
                                           "--roi=" + fmt::format("{}", fmt::join(box, ","))});
  const auto exit = again->wait(kClusterPatience);
  ASSERT_TRUE(exit && exit->succeeded()) << testing::PrintToString(again->lines());
  for (const auto& [module, bytes] : pictures) {
    const auto expected = read_file(image_path(reference, 0, static_cast<std::uint32_t>(module), proto::COLOR));
    ASSERT_TRUE(expected);
    EXPECT_EQ(bytes, *expected) << module;
  }
}

}  // namespace
}  // namespace lfd::harness
