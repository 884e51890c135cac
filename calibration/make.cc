// Named displays and their perturbation.
#include "calibration/make.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/log.h"
#include "calibration/random.h"

namespace lfd {
namespace {

struct NamedDisplay {
  const char* name;
  int modules;
  ImageSize image;
  ScreenSize screen;
  double fov_deg;              // counted at the screen's centre
  double observer_distance_m;  // vz
  double emitter_z_m;          // ez
  Diffuser diffuser = Diffuser::kLinear;
  double emitter_y_m = 0;
};

constexpr std::array kDisplays = {
    NamedDisplay{"desk", 8, {256, 192}, {0.40, 0.30}, 40, 0.8, -0.6},
    NamedDisplay{"128wld", 128, {320, 240}, {0.65, 0.49}, 50, 1.2, -0.9},
    NamedDisplay{"crs4", 72, {800, 600}, {1.60, 0.90}, 50, 3.0, -1.8},
    NamedDisplay{"640rc", 64, {1024, 768}, {1.59, 0.90}, 60, 3.0, -1.8},
    NamedDisplay{"722rc", 72, {1280, 800}, {1.59, 0.99}, 70, 3.0, -1.8},
    NamedDisplay{"c80", 80, {1024, 768}, {3.00, 1.80}, 40, 7.0, -6.0},
    NamedDisplay{"c80-conical", 80, {1024, 768}, {3.00, 1.80}, 40, 7.0, -6.0, Diffuser::kConical, -1.2},
};

// Takes away the last digits, in which the mathematics libraries of machines differ.
double rounded(double value) { return std::round(value * 1e12) / 1e12; }

// A pinhole with the errors of an installation; shares are of the image's width.
PinholeMap with_errors(const PinholeMap& ideal, ImageSize image, Random& random) {
  constexpr double kDegree = std::numbers::pi / 180;
  PinholeMap map = ideal;
  for (double* coordinate : {&map.position.x, &map.position.y, &map.position.z}) {
    *coordinate = rounded(*coordinate + 1e-3 * random.normal());
  }
  // Small half angles; normalising makes them a rotation.
  const double pitch = 0.08 * kDegree * random.normal(), yaw = 0.08 * kDegree * random.normal();
  const double roll = 0.15 * kDegree * random.normal();
  const glm::dquat turn = glm::normalize(glm::dquat(1, 0.5 * pitch, 0.5 * yaw, 0.5 * roll));
  map.orientation = glm::dquat(rounded(turn.w), rounded(turn.x), rounded(turn.y), rounded(turn.z));
  const double zoom = 1.5e-3 * random.normal();
  map.focal_u_px = rounded(ideal.focal_u_px * (1 + zoom + 5e-4 * random.normal()));
  map.focal_v_px = rounded(ideal.focal_v_px * (1 + zoom + 5e-4 * random.normal()));
  map.principal_u_px = rounded(ideal.principal_u_px + 1.5e-3 * image.width * random.normal());
  map.principal_v_px = rounded(ideal.principal_v_px + 1.5e-3 * image.width * random.normal());
  // Each coefficient moves the furthest corner by a share of the image's width.
  const double r = corner_radius(map, image);
  const double width = image.width / map.focal_u_px;
  map.k1 = rounded(3e-3 * random.normal() * width / (r * r * r));
  map.k2 = rounded(1.5e-3 * random.normal() * width / (r * r * r * r * r));
  map.p1 = rounded(8e-4 * random.normal() * width / (3 * r * r));
  map.p2 = rounded(8e-4 * random.normal() * width / (3 * r * r));
  return map;
}

// Before anything is computed. All is held in memory, and again while it is written: of the most points about 2 GiB.
Status check_grid(int columns, int rows, std::size_t modules) {
  for (const int side : {columns, rows}) {
    if (side < 2 || side > kMaxGridSide)
      return Error(fmt::format("{} x {} points; 2 to {} a side are possible", columns, rows, kMaxGridSide));
  }
  const std::size_t all = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * modules;
  if (all <= kMostMeasured) return {};
  return Error(fmt::format("{} x {} points of {} modules are {} in all; at most {} are possible", columns, rows,
                           modules, all, kMostMeasured));
}

std::string known_names() {
  std::string names;
  for (const NamedDisplay& display : kDisplays) names += (names.empty() ? "" : ", ") + std::string(display.name);
  return names;
}

}  // namespace

std::vector<std::string> display_names() {
  std::vector<std::string> names;
  names.reserve(kDisplays.size());
  for (const NamedDisplay& display : kDisplays) names.emplace_back(display.name);
  return names;
}

Result<DisplayCalibration> make_display(std::string_view name, std::optional<int> modules) {
  const auto* named =
      std::find_if(kDisplays.begin(), kDisplays.end(), [name](const auto& d) { return d.name == name; });
  if (named == kDisplays.end()) return Error(fmt::format("no display is named \"{}\"; known: {}", name, known_names()));
  const int count = modules.value_or(named->modules);
  if (count < 1 || count > kMaxModules)
    return Error(fmt::format("{} modules; 1 to {} are possible", count, kMaxModules));
  DisplayCalibration display;
  display.name = named->name;
  display.screen = named->screen;
  display.image = named->image;
  display.optics = {named->diffuser, 0, named->observer_distance_m};
  const double fov_rad = named->fov_deg * std::numbers::pi / 180;
  const double half_span = -named->emitter_z_m * std::tan(0.5 * fov_rad);
  for (int k = 0; k < count; ++k) {
    const double x = count == 1 ? 0 : half_span * (2.0 * k / (count - 1) - 1);
    display.modules.push_back({{rounded(x), named->emitter_y_m, named->emitter_z_m}, IdealMap{}});
  }
  // A single module has no neighbour: it is to be seen from the whole field.
  display.angular_scattering_rad = rounded(count == 1 ? 1.5 * fov_rad : scattering_by_rule_rad(display.modules));
  return display;
}

double scattering_by_rule_rad(std::span<const ModuleCalibration> modules) {
  LFD_CHECK(modules.size() >= 2, "one module has no neighbour");
  const std::size_t middle = modules.size() / 2;
  const glm::dvec3 left = to_glm(modules[middle - 1].emitter), right = to_glm(modules[middle].emitter);
  // By the tangent: an arc cosine loses half the digits of small angles.
  return 1.5 * std::atan2(glm::length(glm::cross(left, right)), glm::dot(left, right));
}

PinholeMap pinhole_of_ideal(ScreenSize screen, ImageSize image, const Emitter& emitter) {
  PinholeMap map;
  map.position = emitter;
  map.focal_u_px = -emitter.z * image.width / screen.width_m;
  map.focal_v_px = -emitter.z * image.height / screen.height_m;
  map.principal_u_px = image.width * (0.5 + emitter.x / screen.width_m);
  map.principal_v_px = image.height * (0.5 - emitter.y / screen.height_m);
  return map;
}

DisplayCalibration perturbed(const DisplayCalibration& display, std::uint64_t seed) {
  DisplayCalibration result = display;
  result.name += fmt::format("-perturbed-{}", seed);
  Random random(seed);
  for (ModuleCalibration& module : result.modules) {
    if (!std::holds_alternative<IdealMap>(module.map)) continue;
    const PinholeMap map =
        with_errors(pinhole_of_ideal(display.screen, display.image, module.emitter), display.image, random);
    module.emitter = map.position;
    module.map = map;
  }
  return result;
}

Result<DisplayCalibration> measured(const DisplayCalibration& display, int columns, int rows, double bump_px,
                                    std::uint64_t seed) {
  LFD_TRY_STATUS(check_grid(columns, rows, display.modules.size()));
  DisplayCalibration result = display;
  result.name += fmt::format("-measured-{}", seed);
  Random random(seed);
  for (std::size_t k = 0; k < result.modules.size(); ++k) {
    const ImageSize image = display.image;
    GridNodes nodes{columns, rows, 0, 0, image.width / (columns - 1.0), image.height / (rows - 1.0), {}};
    const double along_u = 2 + random.normal(), along_v = 2 + random.normal(), phase = 3 * random.normal();
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const PixelPoint place = nodes.place(column, row);
        const double a = along_u * place.x / image.width + phase, b = along_v * place.y / image.height - phase;
        const PixelPoint moved{place.x + bump_px * std::sin(b + std::cos(a)),
                               place.y + bump_px * std::cos(a - std::sin(b))};
        const auto s = lit_by(display, display.modules[k].map, moved);
        const double hole = std::numeric_limits<double>::quiet_NaN();
        nodes.node.push_back(s ? ScreenPoint{rounded(s->x), rounded(s->y)} : ScreenPoint{hole, hole});
      }
    }
    auto map = GridMap::make(std::move(nodes));
    if (!map) return map.error().within(fmt::format("module {}", k));
    result.modules[k].map = *map;
  }
  return result;
}

Result<DisplayCalibration> curved(const DisplayCalibration& display, double radius_m, bool observer_arc) {
  if (radius_m == 0) return Error("radius: 0 m is no cylinder");
  DisplayCalibration result = display;
  result.name += radius_m > 0 ? "-convex" : "-concave";
  result.optics.screen_radius_m = radius_m;
  result.optics.observer_arc = observer_arc;
  LFD_TRY_STATUS(validate(result));
  // A place before a plane (arc length, distance) is kept before the arc.
  const auto bent = [&](const Point3<Physical>& place, double angle) {
    const Point3<Physical> at = surface_point(result.optics, {place.x, place.y});
    return Point3<Physical>{rounded(at.x + place.z * std::sin(angle)), place.y,
                            rounded(at.z + place.z * std::cos(angle))};
  };
  for (ModuleCalibration& module : result.modules) {
    const double angle = module.emitter.x / radius_m;
    module.emitter = bent(module.emitter, angle);
    if (auto* map = std::get_if<PinholeMap>(&module.map)) {
      map->position = bent(map->position, angle);
      const glm::dquat turned = glm::angleAxis(angle, glm::dvec3(0, 1, 0)) * map->orientation;
      map->orientation = {rounded(turned.w), rounded(turned.x), rounded(turned.y), rounded(turned.z)};
    }
  }
  LFD_TRY_STATUS(validate(result));
  return result;
}

}  // namespace lfd
