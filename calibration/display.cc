// The product of optics and map, with every limit.
#include "calibration/display.h"

#include <cmath>
#include <numbers>
#include <type_traits>

#include "base/log.h"
#include "calibration/curved_screen.h"

namespace lfd {
namespace {

Status validate_map(const IdealMap&) { return {}; }

Status validate_map(const HomographyMap& map) {
  if (auto status = validate(map); !status) return status.error().within("homography");
  return {};
}

Status validate_map(const PinholeMap& map) {
  if (auto status = validate(map); !status) return status.error().within("pinhole");
  return {};
}

Status validate_map(const GridMap&) { return {}; }  // was checked when it was made

// Where the pinhole's ray of a pixel crosses the screen toward the viewer.
std::optional<ScreenPoint> pinhole_on_screen(const Optics& optics, const PinholeMap& map, PixelPoint p) {
  if (optics.screen_radius_m == 0) return screen_from_image(map, p);
  const auto direction = direction_of_pixel(map, p);
  if (!direction) return std::nullopt;
  const double horizontal = std::hypot(direction->x, direction->z);
  if (!(horizontal > 0)) return std::nullopt;
  const CurvedScreen screen(optics.screen_radius_m);
  const glm::dvec2 from(map.position.x, map.position.z), along(direction->x / horizontal, direction->z / horizontal);
  const auto distance = screen.rise_through(from, along, 0);
  if (!distance || !(*distance > 0)) return std::nullopt;
  const auto s = screen.arc_length_of(from + *distance * along);
  if (!s) return std::nullopt;
  return ScreenPoint{*s, map.position.y + *distance * (direction->y / horizontal)};
}

Status validate_module(const ModuleCalibration& module) {
  LFD_TRY_STATUS(validate(module.emitter));
  if (module.color) {
    if (auto status = validate(*module.color); !status) return status.error().within("color");
  }
  return std::visit([](const auto& map) { return validate_map(map); }, module.map);
}

}  // namespace

Status validate(const DisplayCalibration& display) {
  for (const auto& [name, value] :
       {std::pair{"screen: width_m", display.screen.width_m}, std::pair{"screen: height_m", display.screen.height_m},
        std::pair{"angular_scattering_rad", display.angular_scattering_rad}}) {
    if (!(value > 0) || !std::isfinite(value))
      return Error(fmt::format("{}: {} must be positive and finite", name, value));
  }
  for (const auto& [name, value] :
       {std::pair{"image: width_px", display.image.width}, std::pair{"image: height_px", display.image.height}}) {
    if (value < 1 || value > kMaxImageSide_px) {
      return Error(fmt::format("{}: {} px; 1 to {} are possible", name, value, kMaxImageSide_px));
    }
  }
  if (auto status = validate(display.optics); !status) return status.error().within("optics");
  const double radius = std::abs(display.optics.screen_radius_m);
  if (radius > 0 && !(display.screen.width_m < std::numbers::pi * radius)) {
    return Error(fmt::format("screen: width_m: {} is more than half of the cylinder's circumference, {:.6g}",
                             display.screen.width_m, std::numbers::pi * radius));
  }
  if (display.modules.empty() || display.modules.size() > kMaxModules) {
    return Error(fmt::format("module: {} of them; 1 to {} are possible", display.modules.size(), kMaxModules));
  }
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    if (auto status = validate_module(display.modules[k]); !status) {
      return status.error().within(fmt::format("module {}", k));
    }
  }
  return {};
}

std::optional<PixelPoint> image_from_screen(const DisplayCalibration& display, const ModuleCalibration& module,
                                            ScreenPoint s) {
  if (!contains(display.screen, s)) return std::nullopt;
  const auto p = std::visit(
      [&](const auto& map) -> std::optional<PixelPoint> {
        using Map = std::decay_t<decltype(map)>;
        if constexpr (std::is_same_v<Map, IdealMap>) return image_from_screen(map, display.screen, display.image, s);
        if constexpr (std::is_same_v<Map, PinholeMap>) return image_from_point(map, surface_point(display.optics, s));
        if constexpr (std::is_same_v<Map, HomographyMap> || std::is_same_v<Map, GridMap>)
          return image_from_screen(map, s);
      },
      module.map);
  if (!p || !contains(display.image, *p)) return std::nullopt;
  return p;
}

std::optional<ScreenPoint> lit_by(const DisplayCalibration& display, const ScreenMap& screen_map, PixelPoint p) {
  return std::visit(
      [&](const auto& map) -> std::optional<ScreenPoint> {
        using Map = std::decay_t<decltype(map)>;
        if constexpr (std::is_same_v<Map, IdealMap>) return screen_from_image(map, display.screen, display.image, p);
        if constexpr (std::is_same_v<Map, PinholeMap>) return pinhole_on_screen(display.optics, map, p);
        if constexpr (std::is_same_v<Map, HomographyMap> || std::is_same_v<Map, GridMap>) {
          return screen_from_image(map, p);
        }
      },
      screen_map);
}

std::optional<ScreenPoint> screen_from_image(const DisplayCalibration& display, const ModuleCalibration& module,
                                             PixelPoint p) {
  if (!contains(display.image, p)) return std::nullopt;
  const auto s = lit_by(display, module.map, p);
  if (!s || !contains(display.screen, *s)) return std::nullopt;
  return s;
}

std::optional<ImagePoint> image_from_physical(const DisplayCalibration& display, const ModuleCalibration& module,
                                              Point3<Physical> p) {
  const auto s = screen_from_physical(display.optics, module.emitter, p);
  if (!s) return std::nullopt;
  const auto pixel = image_from_screen(display, module, *s);
  if (!pixel) return std::nullopt;
  return ImagePoint{pixel->x, pixel->y, p.z};
}

std::optional<PixelLine> pixel_line(const DisplayCalibration& display, const ModuleCalibration& module, PixelPoint p) {
  const auto s = screen_from_image(display, module, p);
  if (!s) return std::nullopt;
  return line_of_screen_point(display.optics, module.emitter, *s);
}

}  // namespace lfd
