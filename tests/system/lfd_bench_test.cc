// lfd bench frame to its end: what it prints and leaves.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

TEST(LfdBench, FramePrintsTimesAndErrors) {
  const Workbench bench;
  const auto lfd = start_program(
      "lfd", {"bench", "frame", bench.deployment("sink: NONE", "w.textproto"), "--frames", "2", "--module", "1",
              "--ao-pixels", "5", "--ao-samples", "50", "--out", bench.folder() / "table"});
  const auto exit = lfd->wait(kClusterPatience);
  ASSERT_TRUE(exit && exit->succeeded()) << testing::PrintToString(lfd->lines());
  const auto json = nlohmann::json::parse(*read_file(bench.folder() / "table/frame.json"));
  EXPECT_EQ(json["times"]["frames"], 2);
  EXPECT_EQ(json["times"]["passes"].size(), 6);
  EXPECT_TRUE(json["error"].contains("ao_against_own_limit"));
}

}  // namespace
}  // namespace lfd::harness
