// The frame bench: its tables add up, and what it times is judged true.
#include "bench/frame/frame_bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "bench/frame/print.h"
#include "tests/support/rendering.h"

namespace lfd::bench {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing_support::context;

// A small display in front of two walls and a floor.
FrameBenchOptions corner_on_desk() {
  static const TemporaryFolder kFolder = *TemporaryFolder::make("lfd-frame-bench");
  const std::filesystem::path path = kFolder.path() / "corner.textproto";
  const Status written = write_file(path, "name: \"corner\"\ndisplay: \"" LFD_SOURCE_DIR
                                          "/configs/displays/desk.textproto\"\nscene { made { name: \"corner\" } }\n"
                                          "node { name: \"only\" }\n");
  LFD_CHECK(written, written.error().message());
  FrameBenchOptions options;
  options.deployment = path;
  options.frames = 3;
  options.ao_subset = {.pixels = 50, .samples = 500};
  return options;
}

const FrameTable& table() {
  static const FrameTable kTable = [] {
    auto made = frame_bench(context(), corner_on_desk());
    LFD_CHECK(made, made.error().message());
    return *std::move(made);
  }();
  return kTable;
}

double sum_of_means(const std::vector<PassRow>& rows, std::optional<Spread> PassRow::*kind) {
  double sum = 0;
  for (const PassRow& row : rows) sum += row.*kind ? (row.*kind)->mean : 0;
  return sum;
}

TEST(Spread, KnownAnswers) {
  const Spread spread = spread_of({4, 1, 3, 2, 10});
  EXPECT_EQ(spread.mean, 4);
  EXPECT_EQ(spread.median, 3);
  EXPECT_EQ(spread.percent_5, 1);
  EXPECT_EQ(spread.percent_95, 10);
  EXPECT_EQ(spread_of({}).mean, 0);
}

TEST(FrameBench, ColumnsAddUp) {
  const PassTimes& times = table().times;
  // Rounding of a handful of additions.
  EXPECT_NEAR(sum_of_means(times.pass, &PassRow::without_ao), times.sum.without_ao->mean, 1e-9);
  EXPECT_NEAR(sum_of_means(times.pass, &PassRow::with_ao), times.sum.with_ao->mean, 1e-9);
  double difference = 0;
  for (const PassRow& row : times.pass) difference += row.difference_of_means();
  EXPECT_NEAR(difference, times.sum.difference_of_means(), 1e-9);
}

TEST(FrameBench, OnlyFramesWithOcclusionHaveItsPasses) {
  for (const PassRow& row : table().times.pass) {
    const bool is_ao = row.pass == "ao" || row.pass == "blur_horizontal" || row.pass == "blur_vertical";
    if (is_ao || row.pass == "gbuffer") {
      EXPECT_TRUE(row.with_ao) << row.pass;
      EXPECT_EQ(row.without_ao.has_value(), !is_ao) << row.pass;
    }
  }
  EXPECT_THAT(table().times.left_out_without_ao, testing::Contains(HasSubstr("switched off")));
}

TEST(FrameBench, MiddleModuleUnlessSaid) {
  EXPECT_EQ(table().subject.modules, 8);
  EXPECT_EQ(table().subject.module, 4);
}

TEST(FrameBench, TimedFrameIsTrue) {
  EXPECT_GT(table().error.position.compared, 1000);
  EXPECT_THAT(reference::broken_bounds(table().error.position), IsEmpty());
}

TEST(FrameBench, OcclusionIsNearItsLimit) {
  EXPECT_EQ(table().error.ao.pixels, 50);
  // 8 samples a pixel that share hidden or open with probability 1/2 are off by 0.18 (one standard deviation, 0.14 in
  // the mean); blur and curve only lessen that.
  EXPECT_LT(table().error.ao.mean_absolute, 0.14);
}

TEST(FrameBench, UnknownModuleIsAnError) {
  FrameBenchOptions options = corner_on_desk();
  options.module = 8;
  const auto made = frame_bench(context(), options);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message(), "module 8: display \"desk\" has modules 0 to 7");
}

TEST(FrameBench, MissingDeploymentIsAnError) {
  FrameBenchOptions options;
  options.deployment = "no-such-file.textproto";
  const auto made = frame_bench(context(), options);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error().message(), HasSubstr("no-such-file.textproto"));
}

TEST(FrameBench, EveryFormSaysTheSame) {
  const auto json = nlohmann::json::parse(json_of(table()));
  EXPECT_EQ(json["times"]["frames"], 3);
  EXPECT_EQ(json["times"]["passes"].size(), 6);
  EXPECT_EQ(json["error"]["ao_against_own_limit"]["mae"], table().error.ao.mean_absolute);
  EXPECT_THAT(text_of(table()), HasSubstr("corner (made, seed 0)"));
  EXPECT_THAT(text_of(table()), HasSubstr(table().subject.renderer));

  // Titles, six passes, their sum, the wall clock.
  const std::string csv = csv_of(table());
  EXPECT_EQ(std::ranges::count(csv, '\n'), 9);
  EXPECT_THAT(csv, HasSubstr("\"corner (made, seed 0)\""));
}

}  // namespace
}  // namespace lfd::bench
