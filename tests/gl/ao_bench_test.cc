// The bench of ambient occlusion at a small size: what it says is what was drawn, and it goes on where it was ended.
#include "bench/ao/ao_bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/file.h"
#include "proto/text_file.h"
#include "tests/harness/workbench.h"
#include "tests/support/rendering.h"

namespace lfd::bench {
namespace {

using testing::HasSubstr;

class AoBench : public testing::Test {
 protected:
  AoBench() {
    options_.deployments = {shown("room"), shown("corner")};
    options_.out = bench_.folder() / "out";
    options_.size = ImageSize{32, 24};
    options_.frames = 1;
    options_.rays = 64;
    options_.radii = {0.16};
    options_.methods = {"schmitt"};
    options_.sizes = {{16, 12}, {32, 24}};
    options_.module_counts = {1, 2, 1000};
  }

  std::filesystem::path shown(const std::string& scene) const {
    return bench_.file(scene + ".textproto", "name: \"w\" display: \"display.textproto\" scene { made { name: \"" +
                                                 scene + "\" seed: 1 } } node { name: \"a\" }");
  }

  AoTable run() const {
    auto table = ao_bench(testing_support::context(), options_);
    LFD_CHECK(table, table.error().message());
    return *std::move(table);
  }

  const harness::Workbench bench_;
  AoBenchOptions options_;
};

std::vector<std::vector<std::string>> cells_of(const std::string& csv) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream in(csv);
  for (std::string line; std::getline(in, line);) {
    lines.emplace_back(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        lines.back().emplace_back();
      else
        lines.back().back() += c;
    }
  }
  return lines;
}

TEST_F(AoBench, DrawsEveryRungAtEveryPlace) {
  const AoTable table = run();
  const auto rungs = ladder(options_.methods);
  const auto everywhere = std::ranges::count(rungs, RungUse::kEverywhere, &Rung::use);
  // The middle module has all rungs, the first those of everywhere, the last those of them that are shared: here none.
  EXPECT_EQ(table.rows.size(), 2 * (rungs.size() + static_cast<std::size_t>(everywhere)));
  EXPECT_EQ(table.places.size(), 2U * 3U);
  for (const AoRow& row : table.rows) {
    EXPECT_GT(row.pixels, 100U) << row.rung.name;
    EXPECT_TRUE(row.judged.mae >= 0 && row.judged.mae < 1) << row.rung.name;
    EXPECT_TRUE(row.judged.ssim > -1 && row.judged.ssim <= 1) << row.rung.name;
    EXPECT_GT(row.occlusion_ms.median, 0) << row.rung.name;
    EXPECT_EQ(row.blur_ms.median > 0, row.blur != "none") << row.rung.name;
    EXPECT_GT(row.radius_px, 1);
    EXPECT_GT(row.shared_points, 50U);
  }
  EXPECT_EQ(table.by_size.size(), 2U);
  EXPECT_EQ(table.by_radius.size(), 4U);
  EXPECT_EQ(table.sharing.size(), 2U) << "the display has no thousand modules";
}

// More rays along the surface's own directions come nearer to the reference, or the reference is of something else.
TEST_F(AoBench, MoreDirectionsAreMoreAccurate) {
  options_.methods = {"march"};
  options_.sizes.clear();
  options_.module_counts.clear();
  options_.rays = 1024;
  const AoTable table = run();
  const auto mae = [&](const std::string& name) {
    const auto row =
        std::ranges::find_if(table.rows, [&](const AoRow& r) { return r.rung.name == name && r.is_middle(); });
    LFD_CHECK(row != table.rows.end(), name);
    return row->judged.mae;
  };
  EXPECT_LT(mae("32 directions, 4 steps, no blur"), 0.8 * mae("4 directions, 4 steps, no blur"));
  EXPECT_LT(mae("32 directions, 4 steps, no blur"), 0.7 * table.places.front().mae_of_none)
      << "better than none at all";
}

TEST_F(AoBench, PrintsTheSameRowsEverywhere) {
  const AoTable table = run();
  const auto csv = cells_of(csv_of(table));
  ASSERT_EQ(csv.size(), 1 + table.rows.size() + table.places.size());
  const auto method = static_cast<std::size_t>(std::ranges::find(csv[0], "method") - csv[0].begin());
  ASSERT_LT(method, csv[0].size());
  for (const auto& line : csv) {
    ASSERT_EQ(line.size(), csv[0].size());
    EXPECT_THAT(line[method], testing::AnyOf("method", "raytraced", "schmitt"));
  }
  const auto json = nlohmann::json::parse(json_of(table));
  ASSERT_EQ(json["rows"].size(), table.rows.size());
  EXPECT_EQ(json["rows"][0]["unfitted"]["mae"], table.rows[0].judged.mae);
  for (const std::string& text : {text_of(table), csv_of(table), svg_of(table, table.scenes()[0])}) {
    EXPECT_THAT(text, testing::Not(HasSubstr("nan")));
    EXPECT_THAT(text, testing::Not(HasSubstr("inf")));
  }
}

TEST_F(AoBench, TheFrontFallsAndCanBeReadBack) {
  options_.methods = {"sphere"};
  options_.sizes.clear();
  options_.module_counts.clear();
  const AoTable table = run();
  proto::OcclusionFront front;
  ASSERT_TRUE(parse_text(front_text_of(table), "front", front));
  ASSERT_GT(front.entry_size(), 1) << "more samples cost more and err less";
  for (int i = 1; i < front.entry_size(); ++i) {
    EXPECT_GE(front.entry(i).ratio(), front.entry(i - 1).ratio());
    EXPECT_LT(front.entry(i).mae(), front.entry(i - 1).mae());
  }
  for (const auto& entry : front.entry()) {
    proto::RenderSettings render;
    *render.mutable_ao() = entry.ao();
    EXPECT_TRUE(read_settings(render)) << entry.name();
  }
}

// Pictures and times of an ended run are taken; what is damaged is drawn again.
TEST_F(AoBench, GoesOnWhereItWasEnded) {
  const std::string first = csv_of(run());
  options_.resume = true;
  EXPECT_EQ(csv_of(run()), first) << "times and pictures are the kept ones";
  int damaged = 0;
  for (const auto& file : std::filesystem::directory_iterator(options_.out / "cache")) {
    if (!file.path().filename().string().starts_with("drawn-") || file.path().extension() != ".txt") continue;
    ASSERT_TRUE(write_file(file.path(), "nonsense"));
    ++damaged;
  }
  EXPECT_GT(damaged, 0);
  const AoTable again = run();
  EXPECT_EQ(again.rows.size(), std::ranges::count(first, '\n') - 1 - static_cast<std::ptrdiff_t>(again.places.size()));
}

TEST_F(AoBench, RefusesWhatCannotBe) {
  const auto fault = [&] {
    const auto table = ao_bench(testing_support::context(), options_);
    return table ? std::string() : table.error().message();
  };
  options_.modules = {4};
  EXPECT_THAT(fault(), HasSubstr("module 4: the display has 4"));
  options_.modules = {};
  options_.size = ImageSize{9000, 10};
  EXPECT_THAT(fault(), HasSubstr("9000x10"));
  options_.size = ImageSize{32, 24};
  options_.methods = {"none"};
  EXPECT_THAT(fault(), HasSubstr("\"none\""));
  options_.methods = {"march"};
  options_.deployments.push_back(options_.deployments.front());
  EXPECT_THAT(fault(), HasSubstr("cannot be told apart")) << "a scene that is shown twice";
  options_.radii = {0};
  EXPECT_THAT(fault(), HasSubstr("radius 0"));
}

}  // namespace
}  // namespace lfd::bench
