// Test patterns on the screen, through every kind of map: lines and squares lie where calibration/ says, in double
// precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/gl/guard_band_scene.h"
#include "tests/gl/pattern_pictures.h"

namespace lfd {
namespace {

using namespace testing_support;
using guard_band::desk;
using guard_band::overshooting;
using guard_band::value;
using guard_band::with_homographies;

struct View {
  const char* name;
  DisplayCalibration display;

  friend void PrintTo(const View& view, std::ostream* out) { *out << view.name; }
};

// A hole of one measured node in the image's middle.
DisplayCalibration with_a_hole(DisplayCalibration display) {
  for (auto& module : display.modules) {
    GridNodes nodes = std::get<GridMap>(module.map).nodes();
    const double hole = std::numeric_limits<double>::quiet_NaN();
    nodes.node[static_cast<std::size_t>(nodes.rows / 2 * nodes.columns + nodes.columns / 2)] = {hole, hole};
    module.map = value(GridMap::make(nodes));
  }
  return display;
}

std::vector<View> views() {
  const DisplayCalibration ideal = desk({96, 72});
  return {{"Ideal", ideal},
          {"Homography", with_homographies(ideal, {1.05, 0.02, 3e-5, -0.03, 0.97, -2e-5, 3, -2, 1})},
          {"Overshooting", overshooting(ideal)},
          {"TurnedBy30Degrees", with_homographies(ideal, {0.6, 0.35, 0, -0.35, 0.6, 0, 31, -3, 1})},
          // The left sixth of the screen lies before its horizon; the right quarter lands in the image from behind it.
          {"Horizon", with_homographies(ideal, {-1.0714, -0.8036, -0.02232, 0, 0.5, 0, 80, 18, 1})},
          {"Pinhole", perturbed(ideal, 3)},
          {"Grid", value(measured(perturbed(ideal, 4), 24, 18, 1.0, 2))},
          {"GridWithAHole", with_a_hole(value(measured(ideal, 13, 10, 1.0, 2)))},
          {"Curved", value(curved(ideal, 1.5, false))},
          {"CurvedPinhole", value(curved(perturbed(ideal, 5), -4, true))},
          {"Conical", reference::one_module(Diffuser::kConical, {96, 72})},
          {"ConicalPinhole", perturbed(reference::one_module(Diffuser::kConical, {96, 72}), 6)}};
}

constexpr double kSpacing_m = 0.17;

class PatternOnScreen : public testing::TestWithParam<View> {
 protected:
  FrameResult drawn(proto::TestPattern::Kind kind, double spacing_m = kSpacing_m) const {
    proto::TestPattern pattern = pattern_of(kind);
    pattern.set_space(proto::TestPattern::SCREEN);
    pattern.set_spacing_m(spacing_m);
    return drawn_pattern(display_, pattern);
  }

  std::optional<ScreenPoint> screen_point(std::uint32_t module, PixelPoint p) const {
    return screen_from_image(display_, display_.modules[module], p);
  }

  // How far along each axis the neighbours' screen points are: a pixel's size on the screen; the larger one of two.
  std::optional<glm::dvec2> size_on_screen(std::uint32_t module, PixelPoint p) const {
    glm::dvec2 size(0);
    const auto centre = screen_point(module, p);
    for (const auto& [u, v] : {std::pair(1, 0), {0, 1}}) {
      const auto next = screen_point(module, {p.x + u, p.y + v}), before = screen_point(module, {p.x - u, p.y - v});
      if (!centre || (!next && !before)) return std::nullopt;
      glm::dvec2 step(0);
      for (const auto& other : {next, before}) {
        if (other) step = glm::max(step, glm::abs(glm::dvec2(other->x - centre->x, other->y - centre->y)));
      }
      size += step;
    }
    return size;
  }

  // How far a screen point is inside the border, at its nearest.
  glm::dvec2 inside_by(ScreenPoint s) const {
    return {0.5 * display_.screen.width_m - std::abs(s.x), 0.5 * display_.screen.height_m - std::abs(s.y)};
  }

  const DisplayCalibration& display_ = GetParam().display;
};
INSTANTIATE_TEST_SUITE_P(Maps, PatternOnScreen, testing::ValuesIn(views()),
                         [](const auto& view) { return std::string(view.param.name); });

// Points every millimetre of every line, the border but for.
TEST_P(PatternOnScreen, EveryPixelThatALineMapsToIsLit) {
  const FrameResult frame = drawn(proto::TestPattern::GRID);
  const ScreenSize screen = display_.screen;
  for (std::uint32_t module = 0; module < display_.modules.size(); ++module) {
    const FedPicture picture = fed_picture(frame, module);
    int lit = 0, red = 0;
    const auto expect_lit = [&](ScreenPoint s, bool in_middle) {
      const auto p = image_from_screen(display_, display_.modules[module], s);
      if (!p || pixel_at(*p).column >= display_.image.width || pixel_at(*p).row >= display_.image.height) return;
      if (!screen_point(module, centre_of(pixel_at(*p)))) return;  // its centre lights nothing
      const Levels color = picture.at(pixel_at(*p));
      ASSERT_NE(color, kBlack) << "module " << module << ", " << s.x << ", " << s.y << " at " << p->x << ", " << p->y;
      ++lit;
      if (in_middle && color == kRed) ++red;
    };
    const int columns = static_cast<int>(0.5 * screen.width_m / kSpacing_m);
    const int rows = static_cast<int>(0.5 * screen.height_m / kSpacing_m);
    for (int k = -columns; k <= columns; ++k) {
      for (double y = -0.5 * screen.height_m; y <= 0.5 * screen.height_m; y += 1e-3)
        ASSERT_NO_FATAL_FAILURE(expect_lit({k * kSpacing_m, y}, k == 0));
    }
    for (int k = -rows; k <= rows; ++k) {
      for (double x = -0.5 * screen.width_m; x <= 0.5 * screen.width_m; x += 1e-3)
        ASSERT_NO_FATAL_FAILURE(expect_lit({x, k * kSpacing_m}, k == 0));
    }
    EXPECT_GT(lit, 1000) << "module " << module;
    EXPECT_GT(red, 100) << "module " << module;
  }
}

TEST_P(PatternOnScreen, NoPixelIsLitThatALineOrTheBorderDoesNotPass) {
  const FrameResult frame = drawn(proto::TestPattern::GRID);
  int black = 0, white = 0;
  for (std::uint32_t module = 0; module < display_.modules.size(); ++module) {
    const FedPicture picture = fed_picture(frame, module);
    for (int row = 0; row < display_.image.height; ++row) {
      for (int column = 0; column < display_.image.width; ++column) {
        const PixelIndex i{column, row};
        const Levels color = picture.at(i);
        ++(color == kBlack ? black : white);
        if (color == kBlack) continue;
        const auto s = screen_point(module, centre_of(i));
        ASSERT_TRUE(s) << column << ", " << row << " lights nothing";
        const auto size = size_on_screen(module, centre_of(i));
        if (!size) continue;
        const auto from_line = [&](double x) { return std::abs(x - kSpacing_m * std::round(x / kSpacing_m)); };
        const glm::dvec2 middle = glm::abs(glm::dvec2(s->x, s->y)), reach = 0.55 * *size, inside = inside_by(*s);
        const bool by_line = from_line(s->x) <= reach.x || from_line(s->y) <= reach.y;
        const bool by_border = inside.x <= 2 * reach.x || inside.y <= 2 * reach.y;
        ASSERT_TRUE(by_line || by_border) << "module " << module << ", pixel " << column << ", " << row;
        const bool by_middle = middle.x <= reach.x || middle.y <= reach.y;
        ASSERT_TRUE(by_middle || color != kRed) << column << ", " << row;
      }
    }
  }
  EXPECT_GT(black, white);
}

// Of the modules that light all four sides, each shows where the screen ends.
TEST_P(PatternOnScreen, TheBorderIsALineToo) {
  const FrameResult frame = drawn(proto::TestPattern::GRID, 1e4);  // no other line but the middle's
  for (std::uint32_t module = 0; module < display_.modules.size(); ++module) {
    const FedPicture picture = fed_picture(frame, module);
    for (int row = 1; row + 1 < display_.image.height; ++row) {
      for (int column = 1; column + 1 < display_.image.width; ++column) {
        const PixelPoint p = centre_of({column, row});
        const auto s = screen_point(module, p);
        const auto size = size_on_screen(module, p);
        if (!s || !size) continue;
        const glm::dvec2 inside = inside_by(*s) / *size;  // in pixels
        const double nearest = std::min(inside.x, inside.y);
        const bool is_white = picture.at({column, row}) == kWhite;
        ASSERT_TRUE(is_white || nearest > 0.85) << module << ": " << column << ", " << row;
        ASSERT_TRUE(!is_white || nearest < 1.15) << module << ": " << column << ", " << row;
      }
    }
  }
}

TEST_P(PatternOnScreen, SquaresAreThoseOfTheScreen) {
  const FrameResult frame = drawn(proto::TestPattern::CHECKER);
  for (std::uint32_t module = 0; module < display_.modules.size(); ++module) {
    const FedPicture picture = fed_picture(frame, module);
    int white = 0, black = 0;
    for (int row = 0; row < display_.image.height; ++row) {
      for (int column = 0; column < display_.image.width; ++column) {
        const auto s = screen_point(module, centre_of({column, row}));
        const bool near_border = s && std::min(inside_by(*s).x, inside_by(*s).y) < 1e-5;  // single precision
        const double across = s ? s->x / kSpacing_m : 0, up = s ? s->y / kSpacing_m : 0;
        const bool near_edge =
            s && (std::abs(across - std::round(across)) < 1e-4 || std::abs(up - std::round(up)) < 1e-4);
        if (near_edge || near_border) continue;
        const bool lit = s && (static_cast<int>(std::floor(across)) + static_cast<int>(std::floor(up))) % 2 == 0;
        ASSERT_EQ(picture.at({column, row}), lit ? kWhite : kBlack) << module << ": " << column << ", " << row;
        ++(lit ? white : black);
      }
    }
    EXPECT_GT(std::min(white, black), 100) << "module " << module;
  }
}

TEST(PatternOnScreenDefault, IsATenthOfTheHeight) {
  const DisplayCalibration display = desk({96, 72});
  proto::TestPattern pattern = pattern_of(proto::TestPattern::GRID);
  pattern.set_space(proto::TestPattern::SCREEN);
  const FedPicture by_default = fed_picture(drawn_pattern(display, pattern), 1);
  pattern.set_spacing_m(0.1 * display.screen.height_m);
  EXPECT_TRUE(is_picture(by_default, fed_picture(drawn_pattern(display, pattern), 1)));
  pattern.set_spacing_m(0.11 * display.screen.height_m);
  EXPECT_FALSE(is_picture(by_default, fed_picture(drawn_pattern(display, pattern), 1)));
}

}  // namespace
}  // namespace lfd
