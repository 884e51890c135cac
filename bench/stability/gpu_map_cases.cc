// The map in float on the GPU against double: near its limits, and with every number that calibrations are allowed.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/log.h"
#include "bench/stability/drawing.h"
#include "bench/stability/gpu_points.h"
#include "bench/stability/groups.h"
#include "bench/stability/message_fields.h"
#include "bench/stability/spoilt_displays.h"
#include "proto/calibration_file.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "map on the GPU";
constexpr double kEpsilon = std::numeric_limits<float>::epsilon();

Point3<Physical> as_float(Point3<Physical> p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// Points of the module's own lines at shares of the way to a limit, 1e-1 to 1e-12 from it, on one side or the other;
// rounded to float, as the GPU gets them.
std::vector<Point3<Physical>> approaching(const DisplayCalibration& display, bool to_observers, double side) {
  std::vector<Point3<Physical>> points;
  const Optics& optics = display.optics;
  for (const ScreenPoint s : {ScreenPoint{0, 0}, {0.15, 0.1}, {-0.17, -0.12}, {-0.1, 0.05}, {0.03, -0.08}}) {
    const auto line = line_of_screen_point(optics, display.modules[0].emitter, s);
    if (!line) continue;
    for (double share = 1e-1; share > 5e-13; share *= 0.1) {
      const double limit = to_observers ? optics.observer_distance_m : line->singular_depth;
      const double depth = limit * (1 + side * share);
      points.push_back(as_float(line->on_screen +
                                (depth / optics.observer_distance_m) * (line->on_observer_line - line->on_screen)));
    }
  }
  return points;
}

// What the map makes of p and of the points that float may take for it: rounding coordinates and parameters moves p by
// two roundings at 1 m.
struct Expected {
  bool all = false, none = false;  // have an image
  double allowed_px = 0;           // where all have: how far float may be off
};

Expected expected_at(const DisplayCalibration& display, Point3<Physical> p) {
  const double h = 2 * kEpsilon;
  const auto at = image_from_physical(display, display.modules[0], p);
  Expected expected{at.has_value(), !at, 10 * 128 * kEpsilon};  // 10 roundings of pixels up to 128
  for (const Vector3<Physical>& d :
       {Vector3<Physical>{h, 0, 0}, {-h, 0, 0}, {0, h, 0}, {0, -h, 0}, {0, 0, h}, {0, 0, -h}}) {
    const auto moved = image_from_physical(display, display.modules[0], p + d);
    expected.all = expected.all && moved;
    expected.none = expected.none && !moved;
    if (at && moved)
      expected.allowed_px =
          std::max(expected.allowed_px, 10 * 128 * kEpsilon + std::hypot(moved->u - at->u, moved->v - at->v));
  }
  return expected;
}

bool is_sound(const glm::vec4& image, const DisplayCalibration& display) {
  if (image == glm::vec4(0)) return true;
  return image.w == 1 && std::isfinite(image.z) && image.x >= 0 && image.y >= 0 &&
         image.x <= static_cast<float>(display.image.width) && image.y <= static_cast<float>(display.image.height);
}

// least: points about which float is certain, of 60.
StabilityCase near_limit(const std::string& name, const DisplayCalibration& display, bool to_observers, double side,
                         std::size_t least) {
  return bounded(
      kGroup, name, 1,
      "of what float's roundings allow; an image, or none, wherever they do not decide; never a number that is not "
      "finite",
      [display, to_observers, side](Worst& worst) {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        const auto points = approaching(display, to_observers, side);
        const auto found = gpu_images({display}, points);
        if (!found) return worst.take(kInfinity);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const glm::vec4& image = (*found)[i];
          const Expected expected = expected_at(display, points[i]);
          if (!is_sound(image, display)) worst.take(kInfinity);
          if (expected.none) worst.take(image.w == 0 ? 0 : kInfinity);
          if (!expected.all) continue;
          const auto at = image_from_physical(display, display.modules[0], points[i]);
          worst.take(image.w == 1 ? std::hypot(image.x - at->u, image.y - at->v) / expected.allowed_px : kInfinity);
        }
      },
      least);
}

// Every display that comes of a bad number and is accepted.
std::vector<DisplayCalibration> accepted(const DisplayCalibration& display) {
  std::vector<DisplayCalibration> found;
  for (const NumberField& field : number_fields(write_calibration(display))) {
    for (const auto& [value, message] : field.spoilt) {
      auto read = read_calibration(dynamic_cast<const proto::DisplayCalibration&>(*message));
      if (read) found.push_back(*std::move(read));
    }
  }
  return found;
}

StabilityCase spoilt(const NamedDisplay& base) {
  return faultless(kGroup, base.kind + ": every accepted bad number", "an image inside the picture, or none",
                   [display = base.display]() -> std::string {
                     constexpr std::array kPlaces{-1e30, -1e3, -0.6, -0.1, -1e-30, 0.0, 0.05, 0.3, 0.79, 1e30};
                     std::vector<Point3<Physical>> points;
                     for (const double x : kPlaces) {
                       for (const double y : kPlaces) {
                         for (const double z : kPlaces) points.push_back({x, y, z});
                       }
                     }
                     const auto displays = accepted(display);
                     const auto found = gpu_images(displays, points);
                     if (!found) return found.error().message();
                     for (std::size_t i = 0; i < found->size(); ++i) {
                       const glm::vec4& image = (*found)[i];
                       if (is_sound(image, displays[i / points.size()])) continue;
                       const Point3<Physical>& p = points[i % points.size()];
                       return fmt::format("({:g}, {:g}, {:g}) lands at {}, {}, {}, {} on display {}", p.x, p.y, p.z,
                                          image.x, image.y, image.z, image.w, i / points.size());
                     }
                     return "";
                   });
}

// The last shares of the way to a limit are less than a rounding of it: there float may decide either way.
void add_limits(StabilityCases& cases, const std::string& name, const std::string& far_limit,
                const DisplayCalibration& display) {
  cases.push_back(
      near_limit(fmt::format("{}: {} from the front, 1e-1 to 1e-12", name, far_limit), display, false, -1, 20));
  cases.push_back(near_limit(fmt::format("{}: {} from behind, 1e-1 to 1e-12", name, far_limit), display, false, 1, 20));
  cases.push_back(near_limit(name + ": observer line from behind, 1e-1 to 1e-12", display, true, -1, 20));
  cases.push_back(near_limit(name + ": observer line from the front, 1e-1 to 1e-12", display, true, 1, 20));
}

}  // namespace

void add_gpu_map_cases(StabilityCases& cases) {
  add_limits(cases, "linear", "emitter plane", small_display());
  add_limits(cases, "conical", "z_c", small_display(Diffuser::kConical));
  DisplayCalibration curved = small_display();
  curved.optics.screen_radius_m = 0.5;
  add_limits(cases, "curved", "emitter", curved);
  curved.optics.observer_arc = true;
  add_limits(cases, "curved, observers on the arc", "emitter", curved);
  for (const NamedDisplay& base : spoilable_displays()) {
    if (base.kind != "grid" && base.kind != "colour") cases.push_back(spoilt(base));
  }
}

}  // namespace lfd::bench
