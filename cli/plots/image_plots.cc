// What lies over a module's image: warp vectors and round trips.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.h"
#include "calibration/check/acceptance.h"
#include "cli/plots/check_plots.h"
#include "cli/plots/heat_map.h"

namespace lfd::plots {
namespace {

constexpr int kArrowColumns = 21, kArrowRows = 15;
constexpr const char* kHoleInk = "#8a8a8a";
constexpr const char* kFoldInk = "#d62728";
constexpr const char* kBesideInk = "#e8e8e8";
constexpr const char* kNoWayBackInk = "#e377c2";

const ModuleCalibration& module_of(const DisplayCalibration& display, int module) {
  return display.modules[static_cast<std::size_t>(module)];
}

// u to the right, v down.
Axes image_axes(const DisplayCalibration& display, const Box& box) {
  const Range u{0, static_cast<double>(display.image.width)}, v{static_cast<double>(display.image.height), 0};
  return {with_equal_scales(box, u, v), u, v};
}

// Of one screen point: where the ideal map has it, and by how much the module's is away from there.
struct Warp {
  PixelPoint ideal;
  double du_px = 0, dv_px = 0;
  bool is_known = false;

  double length_px() const { return std::hypot(du_px, dv_px); }
};

std::vector<Warp> warps_of(const DisplayCalibration& display, int module) {
  CheckSampling sampling;
  sampling.screen_columns = kArrowColumns;
  sampling.screen_rows = kArrowRows;
  std::vector<Warp> warps;
  for (int row = 0; row < kArrowRows; ++row) {
    for (int column = 0; column < kArrowColumns; ++column) {
      const ScreenPoint s = sampled_screen_point(display, sampling, column, row);
      Warp warp{image_from_screen(IdealMap{}, display.screen, display.image, s)};
      if (const auto p = image_from_screen(display, module_of(display, module), s)) {
        warp = {warp.ideal, p->x - warp.ideal.x, p->y - warp.ideal.y, true};
      }
      warps.push_back(warp);
    }
  }
  return warps;
}

// What becomes of a pixel.
enum class Fate { kThereAndBack, kNoWayBack, kBesideScreen, kHole, kFold };

// Of a pixel without a map: in a grid's cell with all corners it is a fold.
Fate fate_without_map(const GridMap& map, PixelPoint p) {
  const GridNodes& nodes = map.nodes();
  const double x = (p.x - nodes.first_u_px) / nodes.step_u_px, y = (p.y - nodes.first_v_px) / nodes.step_v_px;
  if (!(x >= 0 && x <= nodes.columns - 1 && y >= 0 && y <= nodes.rows - 1)) return Fate::kHole;
  const int column = std::min(static_cast<int>(x), nodes.columns - 2),
            row = std::min(static_cast<int>(y), nodes.rows - 2);
  const bool is_complete = is_finite(nodes.at(column, row)) && is_finite(nodes.at(column + 1, row)) &&
                           is_finite(nodes.at(column, row + 1)) && is_finite(nodes.at(column + 1, row + 1));
  return is_complete ? Fate::kFold : Fate::kHole;
}

Fate fate_of(const DisplayCalibration& display, const ModuleCalibration& module, PixelPoint p) {
  if (const auto s = screen_from_image(display, module, p)) {
    return image_from_screen(display, module, *s) ? Fate::kThereAndBack : Fate::kNoWayBack;
  }
  return std::visit(
      [&](const auto& map) {
        using Map = std::decay_t<decltype(map)>;
        if constexpr (std::is_same_v<Map, IdealMap>) {
          return Fate::kBesideScreen;
        } else {
          if (screen_from_image(map, p)) return Fate::kBesideScreen;
          if constexpr (std::is_same_v<Map, GridMap>) return fate_without_map(map, p);
          return Fate::kHole;
        }
      },
      module.map);
}

const char* ink_of(Fate fate) {
  switch (fate) {
    case Fate::kThereAndBack:
      return "none";
    case Fate::kNoWayBack:
      return kNoWayBackInk;
    case Fate::kBesideScreen:
      return kBesideInk;
    case Fate::kHole:
      return kHoleInk;
    case Fate::kFold:
      return kFoldInk;
  }
  return "none";
}

// Round trips in px where there are some, colours for everything else.
Field draw_fates(Svg& svg, const Axes& axes, const DisplayCalibration& display, const ModuleCalibration& module) {
  CheckSampling sampling;
  sampling.image_columns = 96;
  sampling.image_rows = 72;
  Field field{sampling.image_columns, sampling.image_rows, {}};
  const double width = axes.box().width / field.columns, height = axes.box().height / field.rows;
  svg.begin_crisp();
  for (int row = field.rows - 1; row >= 0; --row) {  // v runs down, the field's rows up
    for (int column = 0; column < field.columns; ++column) {
      const PixelPoint p = sampled_pixel(display, sampling, column, row);
      const Fate fate = fate_of(display, module, p);
      field.value.push_back(std::numeric_limits<double>::quiet_NaN());
      if (fate == Fate::kThereAndBack) {
        const auto back = image_from_screen(display, module, *screen_from_image(display, module, p));
        field.value.back() = std::hypot(back->x - p.x, back->y - p.y);
      } else {
        svg.rectangle({axes.box().x + column * width, axes.box().y + row * height, width + 0.4, height + 0.4},
                      {.fill = ink_of(fate)});
      }
    }
  }
  svg.end_group();
  return field;
}

}  // namespace

std::string warp(const DisplayCalibration& display, int module) {
  const std::vector<Warp> warps = warps_of(display, module);
  std::vector<double> lengths;
  for (const Warp& warp : warps) {
    if (warp.is_known) lengths.push_back(warp.length_px());
  }
  const double longest = lengths.empty() ? 0 : *std::ranges::max_element(lengths);
  const double scale = arrow_scale(longest, static_cast<double>(display.image.width) / kArrowColumns);
  const Axes axes = image_axes(display, {90, 60, 720, 620});
  const double bottom = axes.bottom_px();
  Svg svg(860, bottom + 115);
  axes.draw_grid(svg);
  svg.begin_clip(axes.box());
  for (const Warp& warp : warps) {
    const Place from = axes.at(warp.ideal.x, warp.ideal.y);
    if (!warp.is_known) {
      svg.line({from.x - 3, from.y - 3}, {from.x + 3, from.y + 3}, {.stroke = kHoleInk});
      svg.line({from.x - 3, from.y + 3}, {from.x + 3, from.y - 3}, {.stroke = kHoleInk});
      continue;
    }
    svg.circle(from, 1.6, {.fill = "#777777"});
    svg.arrow(from, axes.at(warp.ideal.x + scale * warp.du_px, warp.ideal.y + scale * warp.dv_px), "#1f5fbf");
  }
  svg.end_group();
  axes.draw(svg, {fmt::format("{}, module {}: where the map moves pixels against the ideal one", display.name, module),
                  "u, px", "v, px"});
  svg.text({450, bottom + 66},
           fmt::format("Arrows are drawn {:g} x their length, from the ideal place. Lengths: {} px.", scale,
                       spread_text(lengths)),
           {.anchor = Anchor::kMiddle});
  svg.text({450, bottom + 88}, "Crosses: places of the screen that the module does not light.",
           {.anchor = Anchor::kMiddle});
  return svg.finish();
}

std::string round_trip(const DisplayCalibration& display, int module) {
  const Axes axes = image_axes(display, {90, 60, 640, 560});
  Svg svg(1000, std::max(axes.bottom_px() + 90, 500.0));
  const Field field = draw_fates(svg, axes, display, module_of(display, module));
  const double limit = AcceptanceLimits().round_trip_max_px;
  const double most = *std::ranges::max_element(field.value, {}, [](double v) { return std::isnan(v) ? 0 : v; });
  const ColourScale scale{1e-9 * limit, std::isnan(most) ? limit : std::max(limit, most), true};
  draw_field(svg, axes, field, scale);
  axes.draw(svg, {fmt::format("{}, module {}: image to screen and back, distance in px", display.name, module), "u, px",
                  "v, px"});
  draw_scale(svg, {780, 80, 18, 260}, scale, fmt::format("px (log); {:g} is accepted", limit));
  draw_key(svg, {780, 365}, kBesideInk, "beside the screen");
  draw_key(svg, {780, 389}, kHoleInk, "no map: hole or border");
  draw_key(svg, {780, 413}, kFoldInk, "no map: folded");
  draw_key(svg, {780, 437}, kNoWayBackInk, "no way back");
  svg.text({410, axes.bottom_px() + 66}, fmt::format("Round trip, px: {}", spread_text(field.value)),
           {.anchor = Anchor::kMiddle});
  return svg.finish();
}

}  // namespace lfd::plots
