// Test patterns as settings: defaults, and every bad field by name.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "proto/settings.h"
#include "proto/text_file.h"

namespace lfd {
namespace {

Result<PatternSettings> read(const std::string& text) {
  proto::TestPattern message;
  const auto parsed = parse_text(text, "pattern", message);
  EXPECT_TRUE(parsed) << text;
  return read_pattern(message);
}

std::string error_of(const std::string& text) {
  const auto pattern = read(text);
  return pattern ? "" : pattern.error().message();
}

TEST(PatternSettings, HaveDefaults) {
  EXPECT_FALSE(read("")->is_shown());
  const PatternSettings number = *read("kind: NUMBER");
  EXPECT_TRUE(number.is_shown());
  EXPECT_EQ(number.kind, PatternKind::kNumber);
  EXPECT_EQ(number.color, glm::vec3(1));
  const PatternSettings grid = *read("kind: GRID");
  EXPECT_FALSE(grid.on_screen);
  EXPECT_EQ(grid.spacing_px, 32);
  EXPECT_EQ(grid.spacing_m, 0) << "the screen's height decides";
}

TEST(PatternSettings, AreReadAsTheyAreWritten) {
  const PatternSettings checker =
      *read("kind: CHECKER space: SCREEN spacing_m: 0.25 color { g: 0.5 } modules: \"17\" modules: \"20-25\"");
  EXPECT_EQ(checker.kind, PatternKind::kChecker);
  EXPECT_TRUE(checker.on_screen);
  EXPECT_EQ(checker.spacing_m, 0.25);
  EXPECT_EQ(checker.color, glm::vec3(0, 0.5, 0)) << "what is not said of a colour is 0";
  EXPECT_EQ(checker.modules, (std::vector<ModuleRange>{{17, 17}, {20, 25}}));
  EXPECT_EQ(read("kind: GRID spacing_px: 8192")->spacing_px, 8192);
  EXPECT_EQ(read("kind: SOLID color {}")->color, glm::vec3(0));
}

TEST(PatternSettings, KnowTheModulesThatShowThem) {
  const PatternSettings some = *read("kind: SOLID modules: \"17\" modules: \"20-25\"");
  for (const int module : {17, 20, 22, 25}) EXPECT_TRUE(some.is_shown_by(module)) << module;
  for (const int module : {0, 16, 18, 19, 26}) EXPECT_FALSE(some.is_shown_by(module)) << module;
  EXPECT_TRUE(read("kind: SOLID")->is_shown_by(1023));
}

TEST(PatternSettings, RefuseModulesThatTheDisplayLacks) {
  const PatternSettings some = *read("kind: SOLID modules: \"7\" modules: \"2-8\"");
  EXPECT_TRUE(check_modules(some, 9));
  EXPECT_EQ(check_modules(some, 8).error().message(), "pattern.modules 1: 8; the display has modules 0 to 7");
  EXPECT_TRUE(check_modules(*read("kind: SOLID"), 0));
}

TEST(PatternSettings, NameEveryBadField) {
  for (const char* text : {"modules: \"1\"", "space: SCREEN", "kind: NONE color {}"}) {
    EXPECT_EQ(error_of(text),
              "pattern.kind: is missing or NONE beside other fields; NUMBER, GRID, CHECKER and SOLID are possible");
  }
  EXPECT_EQ(error_of("kind: 5"), "pattern.kind: 5; 0 to 4 are possible");
  EXPECT_EQ(error_of("kind: GRID space: 2"), "pattern.space: 2; 0 to 1 are possible");
  EXPECT_EQ(error_of("kind: GRID spacing_px: -3"), "pattern.spacing_px: -3; 1 to 8192 are possible");
  EXPECT_EQ(error_of("kind: CHECKER spacing_px: 8193"), "pattern.spacing_px: 8193; 1 to 8192 are possible");
  EXPECT_EQ(error_of("kind: GRID space: SCREEN spacing_m: -1"), "pattern.spacing_m: -1; 1e-06 to 10000 are possible");
  EXPECT_EQ(error_of("kind: GRID space: SCREEN spacing_m: nan"), "pattern.spacing_m: nan; 1e-06 to 10000 are possible");
  EXPECT_EQ(error_of("kind: SOLID color { r: 1.5 }"), "pattern.color: 1.5; 0 to 1 are possible");
  EXPECT_EQ(error_of("kind: SOLID color { b: -0.5 }"), "pattern.color: -0.5; 0 to 1 are possible");
  EXPECT_EQ(error_of("kind: SOLID modules: \"3\" modules: \"5-4\""), "pattern.modules 1: \"5-4\" runs backwards");
  EXPECT_EQ(error_of("kind: SOLID modules: \"all\""),
            "pattern.modules 0: \"all\" is neither a module number nor a range");
}

TEST(PatternSettings, RefuseWhatDoesNotGoTogether) {
  const std::string px = "pattern.spacing_px: is for kind GRID or CHECKER in space IMAGE only";
  const std::string m = "pattern.spacing_m: is for kind GRID or CHECKER in space SCREEN only";
  for (const char* kind : {"NUMBER", "SOLID"}) {
    const std::string text = std::string("kind: ") + kind;
    EXPECT_EQ(error_of(text + " spacing_px: 8"), px);
    EXPECT_EQ(error_of(text + " spacing_m: 0.1"), m);
    EXPECT_EQ(error_of(text + " space: SCREEN"), "pattern.space: SCREEN is for kind GRID or CHECKER only");
  }
  EXPECT_EQ(error_of("kind: GRID space: SCREEN spacing_px: 8"), px);
  EXPECT_EQ(error_of("kind: CHECKER spacing_m: 0.1"), m);
}

TEST(PatternSettings, AreAPartOfRenderSettings) {
  proto::RenderSettings render;
  EXPECT_FALSE(read_settings(render)->pattern.is_shown());
  render.mutable_pattern()->set_kind(proto::TestPattern::GRID);
  EXPECT_EQ(read_settings(render)->pattern, *read("kind: GRID"));
  render.mutable_pattern()->set_spacing_px(-1);
  EXPECT_EQ(read_settings(render).error().message(), "pattern.spacing_px: -1; 1 to 8192 are possible");
}

TEST(ModuleRangeText, IsANumberOrTwoInOrder) {
  EXPECT_EQ(*parse_range("17"), (ModuleRange{17, 17}));
  EXPECT_EQ(*parse_range("0-1023"), (ModuleRange{0, 1023}));
  for (const char* bad : {"", "-", "3-", "-3", "a", "1-2-3", " 1", "1 ", "4-3", "99999999999", "1,2"})
    EXPECT_FALSE(parse_range(bad)) << bad;
}

}  // namespace
}  // namespace lfd
