// The list.
#include "bench/map/map_variants.h"

#include <algorithm>

#include "base/log.h"

namespace lfd::bench {
namespace {

constexpr double kWhole_px = 1e4;  // no edge is split
constexpr auto kInterpolated = proto::RenderSettings::INTERPOLATED;
constexpr auto kPerPixel = proto::RenderSettings::PER_PIXEL;

MapVariant variant(std::string name, double subdivision_px, proto::RenderSettings::Position position,
                   double tessellation_px = 0, int warp_level = 0) {
  MapVariant made{std::move(name), {}};
  made.render.set_subdivision_px(subdivision_px);
  made.render.set_position(position);
  made.render.set_tessellation_px(tessellation_px);
  made.render.set_warp_level(warp_level);
  return made;
}

}  // namespace

std::vector<MapVariant> map_variants(const DisplayCalibration& display) {
  std::vector<MapVariant> variants{
      variant("plain vertices", kWhole_px, kInterpolated),
      variant("subdivided to 1 px", 1, kInterpolated),
      variant("subdivided to 0.1 px", 0.1, kInterpolated),
      variant("subdivided to 0.02 px", 0.02, kInterpolated),
      variant("tessellated to 0.1 px", kWhole_px, kInterpolated, 0.1),
      variant("per pixel, plain vertices", kWhole_px, kPerPixel),
      variant("per pixel, subdivided to 1 px", 1, kPerPixel),
      variant("per pixel, subdivided to 0.1 px", 0.1, kPerPixel),
      variant("per pixel, subdivided to 0.05 px", 0.05, kPerPixel),
      variant("per pixel, subdivided to 0.02 px", 0.02, kPerPixel),
  };
  const bool is_measured = std::ranges::any_of(
      display.modules, [](const ModuleCalibration& m) { return std::holds_alternative<GridMap>(m.map); });
  for (int level = 4; is_measured && level <= 9; ++level) {
    variants.push_back(variant(fmt::format("per pixel, 0.02 px, warp table of {} columns", (1 << level) + 1), 0.02,
                               kPerPixel, 0, level));
  }
  return variants;
}

}  // namespace lfd::bench
