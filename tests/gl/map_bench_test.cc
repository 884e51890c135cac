// The bench of ways of drawing: what it says is what was drawn, and the ways rank as they must.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/map/map_bench.h"
#include "calibration/make.h"
#include "proto/calibration_file.h"
#include "tests/harness/workbench.h"
#include "tests/support/rendering.h"

namespace lfd::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const MapRow& row_of(const MapTable& table, const std::string& variant) {
  const auto found = std::ranges::find(table.rows, variant, &MapRow::variant);
  LFD_CHECK(found != table.rows.end(), variant);
  return *found;
}

MapTable table_of(const DisplayCalibration& display) {
  const harness::Workbench bench;
  LFD_CHECK(save_calibration(bench.folder() / "display.textproto", display), "a file");
  const auto deployment = bench.file(
      "map.textproto",
      "name: \"map\" display: \"display.textproto\" scene { made { name: \"room\" seed: 1 } } node { name: \"a\" }");
  MapBenchOptions options;
  options.deployment = deployment;
  options.modules = {3};
  options.frames = 1;
  auto table = map_bench(testing_support::context(), options);
  LFD_CHECK(table, table.error().message());
  return *std::move(table);
}

// A room of twelve large triangles seen by a perturbed desk.
TEST(MapBench, RanksTheWaysOfDrawing) {
  const MapTable table = table_of(perturbed(*make_display("desk"), 7));
  const reference::Truth &plain = row_of(table, "plain vertices").truth,
                         &fine = row_of(table, "subdivided to 0.02 px").truth,
                         &tessellated = row_of(table, "tessellated to 0.1 px").truth,
                         &per_pixel = row_of(table, "per pixel, subdivided to 0.02 px").truth;
  EXPECT_GT(plain.percent_99, 1e-3) << "straight edges between corners far apart are wrong in the middle";
  EXPECT_LT(fine.percent_99, 0.1 * plain.percent_99);
  EXPECT_LT(tessellated.percent_99, 0.1 * plain.percent_99);
  EXPECT_LT(per_pixel.percent_99, 0.1 * fine.percent_99);
  EXPECT_LT(tessellated.mismatch_share, 3e-3) << "no cracks";
  EXPECT_GT(row_of(table, "per pixel, subdivided to 0.02 px").triangles, row_of(table, "plain vertices").triangles);
  for (const MapRow& row : table.rows) EXPECT_EQ(row.module, 3U);
}

TEST(MapBench, ComparesTableSizesOfMeasuredMaps) {
  const MapTable table = table_of(*measured(*make_display("desk"), 17, 13, 3, 1));
  const reference::Truth& coarse = row_of(table, "per pixel, 0.02 px, warp table of 17 columns").truth;
  const reference::Truth& fine = row_of(table, "per pixel, 0.02 px, warp table of 257 columns").truth;
  EXPECT_LE(fine.mismatch_share, coarse.mismatch_share);
  EXPECT_LT(fine.max, 1e-3);
}

TEST(MapBench, NamesWhatAWayMisses) {
  MapTable table;
  table.is_software = true;
  MapRow row;
  row.scene = "first";
  row.variant = "a";
  row.module = 7;
  row.truth.percent_999 = 2e-4;
  row.wall_ratio.median = 3;
  table.rows = {row};
  const auto missed = missed_bounds(table, "a");
  ASSERT_EQ(missed.size(), 2U);
  EXPECT_THAT(missed[0], HasSubstr("first, module 7: 99.9 % error 0.0002"));
  EXPECT_THAT(missed[1], HasSubstr("time over plain vertices 3"));
  table.rows[0].truth.percent_999 = 1e-5;
  table.rows[0].wall_ratio.median = 2;
  EXPECT_THAT(missed_bounds(table, "a"), IsEmpty());
  // Errors count on every scene, time on the first.
  row.scene = "second";
  table.rows.push_back(row);
  EXPECT_THAT(missed_bounds(table, "a"), ElementsAre(HasSubstr("second, module 7: 99.9 % error")));
}

TEST(MapBench, PrintsTheSameNumbersEverywhere) {
  const MapTable table = table_of(*make_display("desk"));
  const auto json = nlohmann::json::parse(json_of(table));
  ASSERT_EQ(json["rows"].size(), table.rows.size());
  EXPECT_EQ(json["rows"][0]["variant"], "plain vertices");
  EXPECT_EQ(json["rows"][0]["wall_ratio"], 1);
  EXPECT_EQ(std::ranges::count(csv_of(table), '\n'), static_cast<std::ptrdiff_t>(table.rows.size() + 1));
  EXPECT_THAT(svg_of(table, table.scenes()[0]), testing::Not(HasSubstr("nan")));
  EXPECT_THAT(svg_of(table, table.scenes()[0]), testing::EndsWith("</svg>\n"));
}

}  // namespace
}  // namespace lfd::bench
