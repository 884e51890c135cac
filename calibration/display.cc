// The product of optics and map, with every limit.
#include "calibration/display.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>
#include <tuple>
#include <type_traits>

#include "calibration/curved_screen.h"
#include "calibration/limits.h"

namespace lfd {
namespace {

Status validate_map(const DisplayCalibration&, const IdealMap&) { return {}; }

// Taken as a map of the unit square to the unit square, it must leave of the square's area at least 1e-12: less is
// beyond what the GPU's single precision can draw.
Status validate_map(const DisplayCalibration& display, const HomographyMap& map) {
  if (auto status = validate(map); !status) return status.error().within("homography");
  const glm::dmat3 unit_from_image(glm::dvec3(1.0 / display.image.width, 0, 0),
                                   glm::dvec3(0, 1.0 / display.image.height, 0), glm::dvec3(0, 0, 1));
  const glm::dmat3 screen_from_unit(glm::dvec3(display.screen.width_m, 0, 0), glm::dvec3(0, display.screen.height_m, 0),
                                    glm::dvec3(0, 0, 1));
  const glm::dmat3 unit_from_unit = unit_from_image * map.image_from_screen * screen_from_unit;
  double largest = 0;
  for (int column = 0; column < 3; ++column) largest = std::max(largest, glm::length(unit_from_unit[column]));
  if (std::abs(glm::determinant(unit_from_unit / largest)) > 1e-12) return {};
  return Error("homography: h: the screen is shrunk to a point or a line of the image, beyond single precision");
}

Status validate_map(const DisplayCalibration&, const PinholeMap& map) {
  if (auto status = validate(map); !status) return status.error().within("pinhole");
  return {};
}

Status validate_map(const DisplayCalibration&, const GridMap&) { return {}; }  // was checked when it was made

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

Status validate_module(const DisplayCalibration& display, const ModuleCalibration& module) {
  LFD_TRY_STATUS(validate(module.emitter));
  const double least_m = kLeastCurvedEmitter * display.screen.width_m;
  if (display.optics.screen_radius_m != 0 && !(-module.emitter.z >= least_m)) {
    return Error(fmt::format("emitter: z: {}; on a curved screen it must be at most {:g}, {:g} of the screen's width",
                             module.emitter.z, -least_m, kLeastCurvedEmitter));
  }
  if (module.color) {
    if (auto status = validate(*module.color); !status) return status.error().within("color");
  }
  return std::visit([&](const auto& map) { return validate_map(display, map); }, module.map);
}

}  // namespace

Status validate_without_modules(const DisplayCalibration& display) {
  for (const auto& [name, value, limits] :
       {std::tuple{"screen: width_m", display.screen.width_m, kScreenSide_m},
        {"screen: height_m", display.screen.height_m, kScreenSide_m},
        {"angular_scattering_rad", display.angular_scattering_rad, kScattering_rad}}) {
    if (!(value > 0) || !std::isfinite(value))
      return Error(fmt::format("{}: {} must be positive and finite", name, value));
    LFD_TRY_STATUS(check_magnitude(name, value, limits));
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
  return {};
}

Status validate(const DisplayCalibration& display) {
  LFD_TRY_STATUS(validate_without_modules(display));
  if (display.modules.empty() || display.modules.size() > kMaxModules) {
    return Error(fmt::format("module: {} of them; 1 to {} are possible", display.modules.size(), kMaxModules));
  }
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    if (auto status = validate_module(display, display.modules[k]); !status) {
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
