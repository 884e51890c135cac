// The equations of the screen, in double precision.
#include "calibration/optics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "calibration/curved_screen.h"
#include "calibration/limits.h"

namespace lfd {
namespace {

// A horizontal ray of a curved screen, by path lengths from a point on it, not from the emitter: that may be 1e6 m
// away.
struct CurvedRay {
  glm::dvec2 direction;  // unit, (x, z)
  double from_emitter = 0;
  double to_screen = 0;  // negative: the screen lies behind the point
  double to_observers = 0;
};

// The ray from the emitter through `through` (x, z). Absent where the two coincide, where it does not cross the screen
// toward the viewer, or does not reach the observers after that.
std::optional<CurvedRay> curved_ray(const Optics& optics, const Emitter& emitter, glm::dvec2 through) {
  const CurvedScreen screen(optics.screen_radius_m);
  const glm::dvec2 along = through - glm::dvec2(emitter.x, emitter.z);
  CurvedRay ray;
  ray.from_emitter = std::hypot(along.x, along.y);
  if (!(ray.from_emitter > 0) || !std::isfinite(ray.from_emitter)) return std::nullopt;
  ray.direction = along / ray.from_emitter;
  const auto to_screen = screen.rise_through(through, ray.direction, 0);
  if (!to_screen || !(ray.from_emitter + *to_screen > 0)) return std::nullopt;
  ray.to_screen = *to_screen;
  const double vz = optics.observer_distance_m;
  if (optics.observer_arc) {
    const auto to_observers = screen.rise_through(through, ray.direction, screen.level({0, vz}));
    if (!to_observers) return std::nullopt;
    ray.to_observers = *to_observers;
  } else {
    if (!(ray.direction.y > 0)) return std::nullopt;
    ray.to_observers = (vz - through.y) / ray.direction.y;
  }
  if (!(ray.to_observers > ray.to_screen)) return std::nullopt;
  return ray;
}

std::optional<OnScreen> on_curved_screen(const Optics& optics, const Emitter& emitter, Point3<Physical> p) {
  const auto ray = curved_ray(optics, emitter, {p.x, p.z});
  if (!ray || !(ray->to_observers > 0)) return std::nullopt;
  const double whole = ray->to_observers - ray->to_screen;
  const auto s =
      CurvedScreen(optics.screen_radius_m).arc_length_of(glm::dvec2(p.x, p.z) + ray->to_screen * ray->direction);
  if (!s) return std::nullopt;
  const double vy = optics.observer_height_m;
  return OnScreen{{*s, p.y + (p.y - vy) * (-ray->to_screen / ray->to_observers)},
                  optics.observer_distance_m * (-ray->to_screen / whole),
                  ray->from_emitter / (ray->from_emitter + ray->to_screen)};
}

std::optional<OnScreen> on_planar_screen(const Optics& optics, const Emitter& emitter, Point3<Physical> p) {
  const double vz = optics.observer_distance_m;
  const double vy = optics.observer_height_m;
  if (!(p.z > emitter.z) || !(p.z < vz)) return std::nullopt;
  const double sy = vy + (p.y - vy) * (vz / (vz - p.z));
  if (optics.diffuser == Diffuser::kLinear) {
    // Not (x + ex k z / vz) / (1 + k z / vz): near the emitter plane that loses every digit.
    const double w = (p.z - emitter.z) / -emitter.z;
    return OnScreen{{emitter.x + (p.x - emitter.x) * (-emitter.z / (p.z - emitter.z)), sy}, p.z, w};
  }
  const double w = 1 + convergence(optics, emitter, sy) * (p.z / vz);
  if (!(w > 0)) return std::nullopt;
  return OnScreen{{emitter.x + (p.x - emitter.x) / w, sy}, p.z, w};
}

}  // namespace

Status validate(const Optics& optics) {
  const double vz = optics.observer_distance_m;
  if (!std::isfinite(optics.observer_height_m)) return Error("observer_height_m: must be finite");
  if (!(vz > 0) || !std::isfinite(vz)) {
    return Error(
        fmt::format("observer_distance_m: {} must be positive and finite: the observer stands before the screen", vz));
  }
  LFD_TRY_STATUS(check_magnitude("observer_height_m", optics.observer_height_m, kPlace_m));
  LFD_TRY_STATUS(check_magnitude("observer_distance_m", vz, kObserverDistance_m));
  if (!std::isfinite(optics.screen_radius_m)) return Error("screen_radius_m: must be finite; 0 is a planar screen");
  if (const double most = kMostConicalHeight * vz;
      optics.diffuser == Diffuser::kConical && !(std::abs(optics.observer_height_m) <= most)) {
    return Error(
        fmt::format("observer_height_m: {}; magnitudes of up to {:g} are possible with a conical diffuser and "
                    "observers at {} m",
                    optics.observer_height_m, most, vz));
  }
  if (optics.screen_radius_m == 0) {
    if (optics.observer_arc) return Error("observer_arc: a planar screen has no concentric arcs");
    return {};
  }
  LFD_TRY_STATUS(check_magnitude("screen_radius_m", optics.screen_radius_m, kScreenRadius_m));
  if (optics.diffuser == Diffuser::kConical) {
    return Error("diffuser: CONICAL on a curved screen is not supported; curved screens have linear diffusers");
  }
  if (optics.observer_arc && !(optics.screen_radius_m + vz > 0) && !(optics.screen_radius_m + vz < 0)) {
    return Error("observer_arc: the observers would stand on the screen's axis");
  }
  if (optics.observer_arc && optics.screen_radius_m < 0 && vz >= -optics.screen_radius_m) {
    return Error(fmt::format("observer_arc: at {} m it lies beyond the axis of the concave screen, {} m before it", vz,
                             -optics.screen_radius_m));
  }
  return {};
}

Status validate(const Emitter& emitter) {
  for (const auto& [name, value] : {std::pair{"x", emitter.x}, std::pair{"y", emitter.y}, std::pair{"z", emitter.z}}) {
    if (!std::isfinite(value)) return Error(fmt::format("emitter: {}: {} must be finite", name, value));
  }
  if (!(emitter.z < 0))
    return Error(fmt::format("emitter: z: {} must be negative: it stands behind the screen", emitter.z));
  LFD_TRY_STATUS(check_magnitude("emitter: x", emitter.x, kPlace_m));
  LFD_TRY_STATUS(check_magnitude("emitter: y", emitter.y, kPlace_m));
  return check_magnitude("emitter: z", emitter.z, kEmitterDistance_m);
}

double convergence(const Optics& optics, const Emitter& emitter, double sy) {
  const double vz = optics.observer_distance_m;
  if (optics.diffuser == Diffuser::kLinear) return vz / -emitter.z;
  return std::hypot(optics.observer_height_m - sy, vz) / std::hypot(sy - emitter.y, emitter.z);
}

std::optional<OnScreen> on_screen(const Optics& optics, const Emitter& emitter, Point3<Physical> p) {
  const auto found =
      optics.screen_radius_m == 0 ? on_planar_screen(optics, emitter, p) : on_curved_screen(optics, emitter, p);
  if (!found || !is_finite(found->at) || !std::isfinite(found->depth) || !std::isfinite(found->w)) return std::nullopt;
  return found;
}

std::optional<ScreenPoint> screen_from_physical(const Optics& optics, const Emitter& emitter, Point3<Physical> p) {
  const auto found = on_screen(optics, emitter, p);
  if (!found) return std::nullopt;
  return found->at;
}

Point3<Physical> surface_point(const Optics& optics, ScreenPoint s) {
  if (optics.screen_radius_m == 0) return {s.x, s.y, 0};
  const glm::dvec2 q = CurvedScreen(optics.screen_radius_m).point_at(s.x);
  return {q.x, s.y, q.y};
}

std::optional<PixelLine> line_of_screen_point(const Optics& optics, const Emitter& emitter, ScreenPoint s) {
  const double vz = optics.observer_distance_m;
  PixelLine line{surface_point(optics, s), {0, optics.observer_height_m, vz}, 0};
  if (optics.screen_radius_m == 0) {
    const double k = convergence(optics, emitter, s.y);
    line.on_observer_line.x = s.x + (s.x - emitter.x) * k;
    line.singular_depth = std::max(emitter.z, -vz / k);
  } else {
    const glm::dvec2 at(line.on_screen.x, line.on_screen.z);
    const auto ray = curved_ray(optics, emitter, at);
    // The crossing toward the viewer is here, not where the same ray meets the cylinder again.
    if (!ray || !(glm::dot(CurvedScreen(optics.screen_radius_m).outward(at), ray->direction) > 0)) return std::nullopt;
    const glm::dvec2 observer = at + ray->to_observers * ray->direction;
    line.on_observer_line.x = observer.x;
    line.on_observer_line.z = observer.y;
    line.singular_depth = -vz * (ray->from_emitter / ray->to_observers);
  }
  if (!is_finite(line.on_screen) || !is_finite(line.on_observer_line)) return std::nullopt;
  return line;
}

double w_at_depth(const Optics& optics, const Emitter& emitter, ScreenPoint s, double depth) {
  if (optics.screen_radius_m == 0) {
    return 1 + convergence(optics, emitter, s.y) * (depth / optics.observer_distance_m);
  }
  const auto line = line_of_screen_point(optics, emitter, s);
  return line ? 1 - depth / line->singular_depth : 0;
}

}  // namespace lfd
