// lfd bench frame, ao, cluster and stream to their ends: what they print and leave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

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

// The arguments of a bench that takes a second.
std::vector<std::string> small_ao_bench(const Workbench& bench) {
  return {"bench",
          "ao",
          bench.deployment("sink: NONE", "w.textproto"),
          "--out",
          (bench.folder() / "ao").string(),
          "--size",
          "24x16",
          "--rays",
          "16",
          "--frames",
          "1",
          "--radius",
          "0.16",
          "--method",
          "schmitt",
          "--no-scaling"};
}

TEST(LfdBench, AoLeavesTablesPlotsAndPictures) {
  const Workbench bench;
  const auto lfd = start_program("lfd", small_ao_bench(bench));
  const auto exit = lfd->wait(kClusterPatience);
  ASSERT_TRUE(exit && exit->succeeded()) << testing::PrintToString(lfd->lines());
  for (const char* file :
       {"ao.md", "ao.csv", "ao-front.textproto", "ao-plane.svg", "strips/plane-module-002-radius-0.16-schmitt.png"})
    EXPECT_TRUE(std::filesystem::is_regular_file(bench.folder() / "ao" / file)) << file;
  const auto json = nlohmann::json::parse(*read_file(bench.folder() / "ao/ao.json"));
  EXPECT_GT(json["rows"].size(), 5U);
  EXPECT_EQ(json["rows"][0]["method"], "schmitt");
}

TEST(LfdBench, StreamMeasuresEncodingsAndThroughput) {
  const Workbench bench(ImageSize{64, 48});
  const auto lfd =
      start_program("lfd", {"bench", "stream", bench.deployment("sink: NONE", "w.textproto"), "--module", "1,2",
                            "--repeats", "1", "--rounds", "1", "--round-mib", "64", "--out", bench.folder() / "out"});
  const auto exit = lfd->wait(kClusterPatience);
  // On a busy machine a single round says nothing of the bound.
  ASSERT_TRUE(exit && exit->signal == 0 && exit->code < 2) << testing::PrintToString(lfd->lines());
  const auto csv = read_file(bench.folder() / "out/stream.csv");
  ASSERT_TRUE(csv);
  for (const char* row :
       {",color,raw,2,24576,24576,1.0000,", ",color,jpeg 90,2,", ",depth,zstd 19,2,", "\n2097152,32,", "\n3145728,32,"})
    EXPECT_THAT(*csv, testing::HasSubstr(row));
  EXPECT_TRUE(std::filesystem::is_regular_file(bench.folder() / "out/stream-plane.svg"));
}

TEST(LfdBench, AoSaysWhatWasMeant) {
  const Workbench bench;
  const auto lines_of = [&](const std::string& option, const std::string& value) {
    std::vector<std::string> arguments = small_ao_bench(bench);
    arguments.insert(arguments.end(), {option, value});
    const auto lfd = start_program("lfd", arguments);
    const auto exit = lfd->wait(kClusterPatience);
    EXPECT_TRUE(exit && exit->code == 2) << option;
    return testing::PrintToString(lfd->lines());
  };
  EXPECT_THAT(lines_of("--method", "sphre"), testing::HasSubstr("did you mean sphere?"));
  EXPECT_THAT(lines_of("--radius", "0"), testing::HasSubstr("0.001 to 10"));
}

TEST(LfdBench, ClusterLeavesATableAndAPlot) {
  const Workbench bench;
  const auto out = bench.folder() / "cluster";
  const auto lfd =
      start_program("lfd", {"bench", "cluster", "--nodes", "1,2", "--modules", "4", "--frames", "20", "--scene",
                            "plane,ribbed-shell", "--resting", "1,100", "--crowd-frames", "20", "--out", out.string()});
  const auto exit = lfd->wait(kClusterPatience);
  // On a busy machine so few frames say nothing of the bound.
  ASSERT_TRUE(exit && exit->signal == 0 && exit->code < 2) << testing::PrintToString(lfd->lines());
  EXPECT_TRUE(std::filesystem::is_regular_file(out / "cluster.svg"));
  EXPECT_TRUE(std::filesystem::is_regular_file(out / "cluster.md"));
  const std::string csv = *read_file(out / "cluster.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 7) << csv;
  EXPECT_THAT(csv, testing::HasSubstr("\nnodes,4,2,\"plane\","));
  EXPECT_THAT(csv, testing::HasSubstr("\nscenes,4,2,\"ribbed-shell\","));
  EXPECT_THAT(csv, testing::HasSubstr("\nrest,4,2,\"100 at rest, 4 move\","));
}

TEST(LfdBench, AoLeavesNoFolderWhereItCouldNotBegin) {
  const Workbench bench;
  std::vector<std::string> arguments = small_ao_bench(bench);
  arguments.insert(arguments.end(), {"--scene", (bench.folder() / "none.glb").string()});
  for (const bool was_there : {false, true}) {
    if (was_there) std::filesystem::create_directory(bench.folder() / "ao");
    const auto lfd = start_program("lfd", arguments);
    const auto exit = lfd->wait(kClusterPatience);
    EXPECT_TRUE(exit && exit->code == 1) << testing::PrintToString(lfd->lines());
    EXPECT_EQ(std::filesystem::exists(bench.folder() / "ao"), was_there);
  }
}

}  // namespace
}  // namespace lfd::harness
