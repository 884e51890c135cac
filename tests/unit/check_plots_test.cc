// Pictures of checked calibrations: well-formed files of finite numbers, round ticks, and the module they show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "calibration/make.h"
#include "cli/plots/check_plots.h"
#include "cli/plots/heat_map.h"
#include "cli/plots/residual_plot.h"

namespace lfd::plots {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// What is wrong with the tags of an XML text; empty where every one is closed in its order.
std::string fault_of_tags(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return "a tag does not end";
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.starts_with("?")) continue;
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (tag.starts_with("/")) {
      if (open.empty() || open.back() != tag.substr(1)) return "</" + tag.substr(1) + "> closes nothing";
      open.pop_back();
    } else if (!tag.ends_with("/")) {
      open.push_back(name);
    }
    if (std::ranges::count(tag, '"') % 2 != 0) return "<" + tag + "> has an open quote";
  }
  return open.empty() ? "" : "<" + open.back() + "> is open";
}

void expect_well_formed(const std::string& svg) {
  EXPECT_EQ(fault_of_tags(svg), "");
  EXPECT_THAT(svg, HasSubstr("<svg xmlns="));
  for (const char* const word :
       {"\"nan", "\"-nan", "\"inf", "\"-inf", ",nan", ",-nan", ",inf", ",-inf", " nan", " inf"}) {
    EXPECT_THAT(svg, Not(HasSubstr(word)));
  }
}

// A display of small grids; the first has a folded corner and a hole.
DisplayCalibration measured(double radius_m, bool arc) {
  DisplayCalibration display = *make_display("desk", 5);
  display.optics.screen_radius_m = radius_m;
  display.optics.observer_arc = arc;
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    GridNodes nodes{9, 7, 0, 0, 32, 32, {}};
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 9; ++column) {
        nodes.node.push_back({0.05 * (column - 4) + 0.001 * std::sin(row), 0.05 * (3 - row)});
      }
    }
    if (k == 0) {
      nodes.node[0] = {-0.12, 0.08};
      nodes.node[9 * 3 + 5] = {kNan, kNan};
    }
    display.modules[k].map = *GridMap::make(nodes);
  }
  EXPECT_TRUE(validate(display));
  return display;
}

TEST(CheckPlots, AreWellFormedForEveryKindOfDisplay) {
  DisplayCalibration gap = *make_display("desk", 12), dark = *make_display("desk", 1);
  gap.modules.erase(gap.modules.begin() + 4, gap.modules.begin() + 6);
  dark.modules[0].map = HomographyMap{glm::dmat3({100, 0, 0}, {0, -100, 0}, {1e6, 50, 1})};  // lights nothing
  dark.name = "<dark> & \"quoted\"";
  for (const DisplayCalibration& display : {*make_display("desk", 1), perturbed(*make_display("c80-conical", 3), 2),
                                            measured(0, false), measured(1, true), measured(-1, false), gap, dark}) {
    const CheckSampling coarse{8, 6, 9, 7, 3};
    const auto report = check_calibration(display, default_half_depth_m(display), coarse);
    expect_well_formed(overview(display, report));
    expect_well_formed(coverage(display, report));
    expect_well_formed(warp(display, 0));
    expect_well_formed(condition(display, report, 0));
    expect_well_formed(round_trip(display, 0));
    if (std::holds_alternative<GridMap>(display.modules[0].map)) expect_well_formed(grid(display, 0));
  }
}

TEST(CheckPlots, ShowHolesFoldsAndGaps) {
  const DisplayCalibration display = measured(0, false);
  const std::string picture = grid(display, 0), clean = grid(display, 1);
  const std::string red = "fill=\"#d62728\" stroke=\"#d62728\"";
  EXPECT_THAT(picture, HasSubstr(red));
  EXPECT_THAT(clean, Not(HasSubstr(red)));
  EXPECT_THAT(picture, HasSubstr("8.33 % of the cells lack a corner"));  // 4 of 48
  EXPECT_THAT(picture, HasSubstr("2.27 % of the others have folded"));   // 1 of 44
  DisplayCalibration gap = *make_display("desk", 12);
  gap.modules.erase(gap.modules.begin() + 4, gap.modules.begin() + 6);
  EXPECT_THAT(overview(gap, check_calibration(gap, 0.05)), HasSubstr("gap: over 2 x the median angle"));
}

TEST(CheckPlots, ScaleOfTheArrowsIsStated) {
  // A shift by 3 px of 256, on 21 columns of arrows: five times as long they span 15 of at most 18 px.
  DisplayCalibration display = *make_display("desk", 1);
  display.modules[0].map = HomographyMap{glm::dmat3({640, 0, 0}, {0, -640, 0}, {131, 96, 1})};
  const std::string picture = warp(display, 0);
  EXPECT_THAT(picture, HasSubstr("Arrows are drawn 5 x their length"));
  EXPECT_THAT(picture, HasSubstr("median 3, max 3 px"));
  EXPECT_THAT(warp(*make_display("desk", 1), 0), HasSubstr("Arrows are drawn 1 x their length"));
}

TEST(ResidualPlot, StatesItsScaleAndMarksOutliers) {
  const DisplayCalibration display = *make_display("desk", 1);
  std::vector<SeenPoint> points;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      const PixelPoint p{10.0 + 20 * i, 8.0 + 15 * j};
      // Every pixel is seen 0.3 px left of where the map has its light.
      points.push_back({{p.x - 0.3, p.y}, *screen_from_image(display, display.modules[0], p), false});
    }
  }
  points[5].in_image.x += 20;
  points[5].is_outlier = true;
  points[6].on_screen = {9, 9};
  const std::string picture = residuals(display, 0, points);
  expect_well_formed(picture);
  EXPECT_THAT(picture, HasSubstr("50 x their length"));  // 15 px of at most 27.7, one and a half times the spacing
  EXPECT_THAT(picture, HasSubstr("144 observations, 1 of them outliers. Residuals of the others, px: "));
  EXPECT_THAT(picture, HasSubstr("max 0.3"));
  EXPECT_THAT(picture, HasSubstr("fill=\"none\" stroke=\"#d62728\""));
  expect_well_formed(residuals(display, 0, {}));
}

TEST(CheckPlots, ShowTheWorstModule) {
  CalibrationReport report;
  report.modules.resize(4);
  for (MapNumbers& module : report.modules) module.coverage = 1;
  EXPECT_EQ(worst_module(report), 0);
  report.modules[1].condition_max = 5;
  EXPECT_EQ(worst_module(report), 1);
  report.modules[2].coverage = 0.9;
  EXPECT_EQ(worst_module(report), 2);
  report.modules[3].folded = 0.01;
  EXPECT_EQ(worst_module(report), 3);
}

TEST(Svg, EscapesTextAndLeavesOutWhatIsNotFinite) {
  Svg svg(100, 50);
  svg.text({1, 2}, "a<b & \"c\"\n", {});
  svg.circle({kNan, 0}, 1, {.fill = "red"});
  svg.line({0, 0}, {std::numeric_limits<double>::infinity(), 0}, {.stroke = "red"});
  svg.arrow({5, 5}, {5, 5}, "blue");
  const std::string text = svg.finish();
  expect_well_formed(text);
  EXPECT_THAT(text, HasSubstr(">a&lt;b &amp; &quot;c&quot;</text>"));
  EXPECT_THAT(text, Not(HasSubstr("red")));
}

TEST(Axes, TicksAreRoundAndWithinTheRange) {
  EXPECT_THAT(ticks_in({-1, 1}, 4), ElementsAre(-1, -0.5, 0, 0.5, 1));
  EXPECT_THAT(ticks_in({5, 0}, 5), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(ticks_in({1, 1}, 5), IsEmpty());
  EXPECT_THAT(ticks_in({0, kNan}, 5), IsEmpty());
  const Axes axes({10, 20, 100, 50}, {0, 2}, {-1, 1});
  EXPECT_EQ(axes.at(0, -1).x, 10);
  EXPECT_EQ(axes.at(0, -1).y, 70);
  EXPECT_EQ(axes.at(2, 1).x, 110);
  EXPECT_EQ(axes.at(1, 0).y, 45);
}

TEST(ColourScale, RunsFromDarkToBrightAndCutsOutliers) {
  EXPECT_EQ((ColourScale{1, 2}.colour_of(1)), "#440154");
  EXPECT_EQ((ColourScale{1, 2}.colour_of(9)), "#fde725");
  EXPECT_DOUBLE_EQ((ColourScale{1, 100, true}.share_of(10)), 0.5);
  EXPECT_TRUE(scale_for({1, 30, kNan}).is_logarithmic);
  std::vector<double> values(200, 1);
  for (std::size_t i = 0; i < 100; ++i) values[i] = 2;
  values[0] = 1000;
  EXPECT_EQ(scale_for(values).high, 2);
  EXPECT_GT(scale_for({3, 3}).high, 3);
  EXPECT_GT(scale_for({}).high, scale_for({}).low);
}

}  // namespace
}  // namespace lfd::plots
