// Moving maps into larger images, and how far their screens reach.
#include "calibration/guard_band.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/check.h"
#include "base/log.h"
#include "calibration/maps/ideal_homography.h"

namespace lfd {
namespace {

ImageSize banded(ImageSize image, int px) { return {image.width + 2 * px, image.height + 2 * px}; }

HomographyMap moved(const glm::dmat3& image_from_screen, int px) {
  const glm::dmat3 by_band(1, 0, 0, 0, 1, 0, px, px, 1);
  return {by_band * image_from_screen};
}

ScreenMap moved(const DisplayCalibration& display, const ScreenMap& map, int px) {
  if (const auto* homography = std::get_if<HomographyMap>(&map)) return moved(homography->image_from_screen, px);
  if (const auto* pinhole = std::get_if<PinholeMap>(&map)) {
    PinholeMap shifted = *pinhole;
    shifted.principal_u_px += px;
    shifted.principal_v_px += px;
    return shifted;
  }
  if (const auto* grid = std::get_if<GridMap>(&map)) {
    GridNodes nodes = grid->nodes();
    nodes.first_u_px += px;
    nodes.first_v_px += px;
    auto shifted = GridMap::make(std::move(nodes));
    LFD_CHECK(shifted, "a grid is one wherever its nodes lie in the image");
    return *std::move(shifted);
  }
  return moved(ideal_homography(display.screen, display.image), px);
}

// The smallest screen about the origin that all that the module's image lights lies on. Taken at 33 x 33 places, those
// at the border among them: maps are smooth.
ScreenSize lit_size(const DisplayCalibration& display, const ModuleCalibration& module) {
  constexpr int kSteps = 32;
  ScreenSize size;
  for (int j = 0; j <= kSteps; ++j) {
    for (int i = 0; i <= kSteps; ++i) {
      const auto s = lit_by(display, module.map,
                            {display.image.width * static_cast<double>(i) / kSteps,
                             display.image.height * static_cast<double>(j) / kSteps});
      if (!s) continue;
      size = {std::max(size.width_m, 2 * std::abs(s->x)), std::max(size.height_m, 2 * std::abs(s->y))};
    }
  }
  return size;
}

// Of a screen `own` whose images grow by the share `growth`, and of which `lit` is lit.
double grown(double own, double growth, double lit) {
  return std::clamp(lit, own * (1 + growth), own * (1 + 2 * growth));
}

}  // namespace

Status check_guard_band(ImageSize image, int px) {
  const ImageSize size = banded(image, even_guard_band_px(px));
  if (std::max(size.width, size.height) <= kMaxImageSide_px) return {};
  return Error(
      fmt::format("images of {}x{} px become {}x{} with a guard band of {} px; at most {} px a side are possible",
                  image.width, image.height, size.width, size.height, px, kMaxImageSide_px));
}

DisplayCalibration with_guard_band(const DisplayCalibration& display, int px) {
  DisplayCalibration larger = display;
  larger.image = banded(display.image, px);
  const double growth_u = 2.0 * px / display.image.width, growth_v = 2.0 * px / display.image.height;
  larger.screen = {display.screen.width_m * (1 + growth_u), display.screen.height_m * (1 + growth_v)};
  ScreenSize lit;
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    larger.modules[k].map = moved(display, display.modules[k].map, px);
    if (std::holds_alternative<IdealMap>(display.modules[k].map)) continue;
    const ScreenSize reached = lit_size(larger, larger.modules[k]);
    lit = {std::max(lit.width_m, reached.width_m), std::max(lit.height_m, reached.height_m)};
  }
  larger.screen = {grown(display.screen.width_m, growth_u, lit.width_m),
                   grown(display.screen.height_m, growth_v, lit.height_m)};
  constexpr double kMostOfCylinder = 0.999;  // of half of its circumference
  if (const double radius = std::abs(display.optics.screen_radius_m); radius > 0)
    larger.screen.width_m =
        std::max(display.screen.width_m, std::min(larger.screen.width_m, kMostOfCylinder * std::numbers::pi * radius));
  return larger;
}

}  // namespace lfd
