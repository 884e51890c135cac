// What the benches conclude from their tables: the last line, the exit code and the text say what the rows say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bench/map/map_bench.h"
#include "bench/stability/suite.h"
#include "bench/stability/tally.h"

namespace lfd::bench {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

StabilityRow row_of(const std::string& group, const std::string& name, bool passed, double worst = 0) {
  return {group, name, "at most 1", {passed ? "little" : "too much", worst, passed}};
}

StabilityTable table_of(std::vector<StabilityRow> rows) { return {"a renderer", "1.2.3", std::move(rows)}; }

std::string last_line(const std::string& text) {
  EXPECT_THAT(text, EndsWith("\n"));
  const std::string lines = text.substr(0, text.size() - 1);
  return lines.substr(lines.rfind('\n') + 1);
}

TEST(StabilityVerdict, CasesThatMissedAreNamedInTheLastLine) {
  const StabilityTable table =
      table_of({row_of("grids", "a fold", true), row_of("grids", "a hole", false), row_of("regions", "flat", false)});
  EXPECT_THAT(table.missed(),
              ElementsAre("grids: a hole", "regions: flat"));  // not empty: exit code 1 (cli/lfd_bench.cc)
  EXPECT_EQ(verdict_of(table), "2 of 3 cases missed: grids: a hole; regions: flat");
  EXPECT_EQ(last_line(text_of(table)), verdict_of(table));
  EXPECT_THAT(text_of(table), HasSubstr("| a fold | at most 1 | little | 0 | ok |"));
  EXPECT_THAT(text_of(table), HasSubstr("| a hole | at most 1 | too much | 0 | MISSED |"));
}

TEST(StabilityVerdict, OneMissAmongManyIsEnough) {
  std::vector<StabilityRow> rows(600, row_of("points", "near the plane", true));
  rows[599] = row_of("triangles", "needle", false);
  EXPECT_THAT(table_of(rows).missed(), ElementsAre("triangles: needle"));
  EXPECT_EQ(last_line(text_of(table_of(rows))), "1 of 600 cases missed: triangles: needle");
}

TEST(StabilityVerdict, WithoutAMissTheLastLineSaysSo) {
  const StabilityTable table = table_of({row_of("grids", "a fold", true), row_of("grids", "a hole", true)});
  EXPECT_THAT(table.missed(), IsEmpty());
  EXPECT_EQ(last_line(text_of(table)), "all 2 cases came out as stated");
  EXPECT_THAT(text_of(table), Not(HasSubstr("MISSED")));
}

TEST(StabilityVerdict, EveryFormatSaysWhichMissed) {
  StabilityTable table = table_of({row_of("a", "b", true, 0.5), row_of("a", "c", false, kInfinity)});
  table.rows[1].outcome.got = "\"x\" | y, z";
  const auto json = nlohmann::json::parse(json_of(table));
  EXPECT_EQ(json["missed"], nlohmann::json::array({"a: c"}));
  ASSERT_EQ(json["cases"].size(), 2U);
  EXPECT_EQ(json["cases"][0]["passed"], true);
  EXPECT_EQ(json["cases"][0]["worst_error"], 0.5);
  EXPECT_EQ(json["cases"][1]["passed"], false);
  EXPECT_TRUE(json["cases"][1]["worst_error"].is_null());  // JSON has no infinity
  EXPECT_EQ(json["cases"][1]["got"], "\"x\" | y, z");
  const std::string csv = csv_of(table);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 3);
  EXPECT_THAT(csv, HasSubstr("\"a\",\"b\",\"at most 1\",\"little\",5.000000e-01,true,"));
  EXPECT_THAT(csv, HasSubstr("\"a\",\"c\",\"at most 1\",\"\"\"x\"\" | y, z\",inf,false,"));
  EXPECT_THAT(text_of(table), HasSubstr("| \"x\" \\| y, z | inf | MISSED |"));
}

std::string outcome_of(const std::string& error) {
  Tally tally({"posx", "posy"}, "f.mpcdi: mpcdi.xml:#: ");
  tally.refused("nan", error);
  const Outcome outcome = tally.outcome();
  return outcome.passed ? "" : outcome.got;
}

TEST(Tally, ErrorsMustNameThePlaceAndTheField) {
  EXPECT_EQ(outcome_of("f.mpcdi: mpcdi.xml:7: posx: \"nan\""), "");
  EXPECT_EQ(outcome_of("f.mpcdi: mpcdi.xml:123: region r: posy: \"nan\""), "");
  EXPECT_THAT(outcome_of("f.mpcdi: mpcdi.xml:7: posz: \"nan\""), HasSubstr("without the field's name"));
  EXPECT_THAT(outcome_of("f.mpcdi: mpcdi.xml:7: imposx_2: \"nan\""), HasSubstr("without the field's name"));
  EXPECT_THAT(outcome_of("f.mpcdi: mpcdi.xml: posx: \"nan\""), HasSubstr("does not begin with"));
  EXPECT_THAT(outcome_of("f.mpcdi: mpcdi.xml:: posx: \"nan\""), HasSubstr("does not begin with"));
  EXPECT_THAT(outcome_of("mpcdi.xml:7: posx: \"nan\""), HasSubstr("does not begin with"));
  EXPECT_THAT(outcome_of("posx"), HasSubstr("does not begin with"));
}

TEST(Tally, CountsAndKeepsTheFirstFault) {
  EXPECT_FALSE(Tally(std::vector<std::string>{"x"}).outcome().passed) << "no value was tried";
  Tally tally(std::vector<std::string>{"x"});
  tally.refused("nan", "x: nan");
  tally.accepted("0", "");
  tally.accepted("1", "");
  EXPECT_EQ(tally.outcome().got, "1 refused, 2 harmless");
  EXPECT_TRUE(tally.outcome().passed);
  tally.accepted("1e300", "a map that is not finite");
  tally.refused("inf", "something");
  EXPECT_EQ(tally.outcome().got, "1e300: a map that is not finite");
  EXPECT_FALSE(tally.outcome().passed);
}

struct Times {
  double gpu = 1, wall = 1;  // over plain vertices
};

MapRow map_row(const std::string& scene, const std::string& variant, Times times, std::uint32_t module = 0) {
  MapRow row;
  row.scene = scene;
  row.variant = variant;
  row.module = module;
  row.gpu_ratio.median = times.gpu;
  row.wall_ratio.median = times.wall;
  row.truth.percent_999 = 5e-5;
  row.truth.max = 5e-4;
  row.truth.mismatch_share = 1e-4;
  return row;
}

MapTable map_table(std::vector<MapRow> rows, bool is_software = true) {
  MapTable table;
  table.display = "desk";
  table.is_software = is_software;
  table.rows = std::move(rows);
  return table;
}

// Plain vertices miss, by their error.
MapRow plain() {
  MapRow row = map_row("room", "plain", {});
  row.truth.percent_999 = 2e-4;
  return row;
}

TEST(MapVerdict, NamesTheCheapestTheNextCheaperAndWhatItMisses) {
  MapTable table =
      map_table({plain(), map_row("room", "finest", {1.9, 1.9}), map_row("room", "fine", {1.5, 1.5}),
                 map_row("hall", "plain", {}), map_row("hall", "finest", {3, 3}), map_row("hall", "fine", {3, 3}, 4)});
  EXPECT_THAT(text_of(table), EndsWith("\ncheapest that keeps all bounds: fine (1.50 x plain vertices)\n"
                                       "next cheaper: plain (1.00 x), which misses:\n"
                                       "  room, module 0: 99.9 % error 0.0002; at most 0.0001 is allowed\n"));
  // Errors count on every scene: one in the hall is enough for the next dearer way.
  table.rows[5].truth.max = 2e-3;
  EXPECT_THAT(text_of(table), EndsWith("\ncheapest that keeps all bounds: finest (1.90 x plain vertices)\n"
                                       "next cheaper: fine (1.50 x), which misses:\n"
                                       "  hall, module 4: largest error 0.002; at most 0.001 is allowed\n"));
}

TEST(MapVerdict, TheCheapestOfAllHasNoNextCheaper) {
  MapRow good = plain();
  good.truth.percent_999 = 1e-5;
  const std::string text = text_of(map_table({good, map_row("room", "fine", {1.5, 1.5})}));
  EXPECT_THAT(text, EndsWith("\ncheapest that keeps all bounds: plain (1.00 x plain vertices)\n"));
  EXPECT_THAT(text, Not(HasSubstr("next cheaper")));
}

TEST(MapVerdict, SaysWhereNoneKeepsAllBounds) {
  const MapTable table = map_table({plain(), map_row("room", "fine", {2.5, 2.5})});
  EXPECT_THAT(text_of(table), EndsWith("\nnone keeps all bounds\n"));
  EXPECT_THAT(text_of(table), Not(HasSubstr("cheapest")));
  EXPECT_THAT(nlohmann::json::parse(json_of(table))["verdict"].get<std::string>(), HasSubstr("none keeps all bounds"));
}

TEST(MapVerdict, OfSeveralModulesTheSlowestCounts) {
  const MapTable table = map_table({plain(), map_row("room", "a", {1.2, 1.2}, 0), map_row("room", "b", {1.4, 1.4}, 0),
                                    map_row("room", "a", {1.8, 1.8}, 1), map_row("room", "b", {1.6, 1.6}, 1)});
  EXPECT_THAT(text_of(table), HasSubstr("cheapest that keeps all bounds: b (1.60 x plain vertices)"));
}

// By one time the first way is the cheaper one and keeps the bound, by the other one the second.
TEST(MapVerdict, CostIsGpuTimeOnAGpuAndWallTimeOnSoftware) {
  const std::vector<MapRow> rows{plain(), map_row("room", "a", {1.2, 2.4}), map_row("room", "b", {2.6, 1.3})};
  const MapTable on_gpu = map_table(rows, false), on_software = map_table(rows, true);
  EXPECT_THAT(text_of(on_gpu), HasSubstr("cheapest that keeps all bounds: a (1.20 x plain vertices)"));
  EXPECT_THAT(text_of(on_software), HasSubstr("cheapest that keeps all bounds: b (1.30 x plain vertices)"));
  EXPECT_THAT(missed_bounds(on_gpu, "a"), IsEmpty());
  EXPECT_THAT(missed_bounds(on_gpu, "b"), ElementsAre(HasSubstr("2.60; at most 2.00 is allowed")));
  EXPECT_THAT(missed_bounds(on_software, "a"), ElementsAre(HasSubstr("2.40; at most 2.00 is allowed")));
  EXPECT_THAT(missed_bounds(on_software, "b"), IsEmpty());
}

// The order that a way is chosen in is that of the time that counts, also where both ways keep every bound.
TEST(MapVerdict, TheOrderIsThatOfTheTimeThatCounts) {
  const std::vector<MapRow> rows{plain(), map_row("room", "a", {1.2, 1.9}), map_row("room", "b", {1.6, 1.3})};
  EXPECT_THAT(text_of(map_table(rows, false)), HasSubstr("cheapest that keeps all bounds: a (1.20 x"));
  EXPECT_THAT(text_of(map_table(rows, true)), HasSubstr("cheapest that keeps all bounds: b (1.30 x"));
}

TEST(MapBounds, EachIsKeptUpToItsValueAndMissedBeyond) {
  const MapBounds bounds;
  struct Case {
    double reference::Truth::*error;
    double bound;
    std::string words;
  };
  for (const Case& c : {Case{&reference::Truth::percent_999, bounds.percent_999, "99.9 % error"},
                        Case{&reference::Truth::max, bounds.max, "largest error"},
                        Case{&reference::Truth::mismatch_share, bounds.mismatch_share, "coverage mismatch"}}) {
    reference::Truth truth;
    truth.*c.error = c.bound;
    EXPECT_THAT(missed_bounds(truth), IsEmpty()) << c.words;
    for (const double beyond : {1.01 * c.bound, kInfinity, std::nan("")}) {
      truth.*c.error = beyond;
      EXPECT_THAT(missed_bounds(truth), ElementsAre(HasSubstr(c.words))) << beyond;
    }
  }
  EXPECT_EQ(bounds.percent_999, 1e-4);
  EXPECT_EQ(bounds.max, 1e-3);
  EXPECT_EQ(bounds.mismatch_share, 5e-4);
  EXPECT_EQ(bounds.ratio, 2);
}

TEST(MapBounds, TimeCountsOnTheFirstSceneAlone) {
  MapTable table = map_table({map_row("room", "a", {2, 2}), map_row("hall", "a", {9, 9})});
  EXPECT_THAT(missed_bounds(table, "a"), IsEmpty());
  table.rows[0].wall_ratio.median = 2.01;
  EXPECT_THAT(missed_bounds(table, "a"),
              ElementsAre("room, module 0: time over plain vertices 2.01; at most 2.00 is allowed"));
}

}  // namespace
}  // namespace lfd::bench
