// Cylindrical screens of every radius in double, against circles in 113-bit arithmetic and against planes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/log.h"
#include "bench/stability/groups.h"
#include "bench/stability/quad.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "screen radius";
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kObserver = 0.8;
constexpr Emitter kEmitter{-0.05, 0.02, -0.6};

Optics optics_of(double radius_m, bool observer_arc = false) {
  return {Diffuser::kLinear, 0.05, kObserver, radius_m, observer_arc};
}

// Half the width of a screen that a cylinder of this radius can have.
double half_width(double radius_m) { return 0.5 * std::min(0.4, std::abs(radius_m)); }

// How far the observers lie behind the screen point at (x, z), over the way from the emitter to it.
long double beyond_of(const Optics& optics, const Emitter& emitter, Quad x, Quad z) {
  const Quad dx = x - emitter.x, dz = z - emitter.z;
  if (!optics.observer_arc) return static_cast<long double>((kObserver - z) / dz);
  // |E + g (S - E) - C| = |radius + vz|, C = (0, -radius): left from inside, or entered from the side of the screen.
  const Quad radius = optics.screen_radius_m, arc = radius + kObserver;
  const Quad a = dx * dx + dz * dz, b = emitter.x * dx + (emitter.z + radius) * dz;
  const Quad c = Quad(emitter.x) * emitter.x + (emitter.z + radius) * (emitter.z + radius) - arc * arc;
  const Quad root = quad_sqrt(b * b - a * c);
  return static_cast<long double>(((radius > 0 ? root : -root) - b) / a - 1);
}

// The point at depth t of the line of a screen point by the circle's own angles and the straight line to the observers.
Point3<Physical> point_by_circle(const Optics& optics, const Emitter& emitter, ScreenPoint s, double depth) {
  const long double radius_m = optics.screen_radius_m, angle = s.x / radius_m, half = std::sin(angle / 2);
  const long double x = radius_m * std::sin(angle), z = -2 * radius_m * half * half;
  const long double beyond = beyond_of(optics, emitter, x, z);
  const long double along_x = (x - emitter.x) * beyond, along_z = (z - emitter.z) * beyond;
  const long double share = depth / kObserver, vy = optics.observer_height_m;
  return {static_cast<double>(x + share * along_x), static_cast<double>(s.y + share * (vy - s.y)),
          static_cast<double>(z + share * along_z)};
}

constexpr std::array kDepths{-0.4, -0.1, -1e-6, 0.0, 1e-6, 0.1, 0.5, 0.79};

// On a convex screen with a small radius, some of the screen faces away from the emitter or the observers.
bool is_lit(const Optics& optics, const Emitter& emitter, ScreenPoint s) {
  return line_of_screen_point(optics, emitter, s).has_value();
}

void against_circles(Worst& worst, const Optics& optics, const Emitter& emitter = kEmitter) {
  const double radius_m = optics.screen_radius_m;
  for (const double share : {-0.95, -0.5, -0.01, 0.0, 0.3, 0.8}) {
    const ScreenPoint s{share * half_width(radius_m), 0.04};
    if (!is_lit(optics, emitter, s)) continue;
    for (const double depth : kDepths) {
      const Point3<Physical> p = point_by_circle(optics, emitter, s, depth);
      const auto got = on_screen(optics, emitter, p);
      if (!got) {
        worst.take(kInfinity);
        continue;
      }
      // Places of up to a metre are rounded and magnified by 1 / w (along) and 1 / (1 - depth / vz) (up); a ray that is
      // turned by a rounding moves by that over the radius where it grazes the arc.
      const double magnified = (1 + 1 / std::abs(radius_m)) / std::min({1.0, got->w, 1 - depth / kObserver});
      worst.take(std::hypot(got->at.x - s.x, got->at.y - s.y) / (kEpsilon * magnified));
      worst.take((got->depth - depth) / (kEpsilon * magnified));
    }
  }
}

// What the sagitta x^2 / 2R moves: a point of the screen is up to 0.02 m^2 / R before the plane; rays cross it at
// slopes below 1 and the map magnifies by at most 1 / w.
void against_plane(Worst& worst, double radius_m) {
  const Optics curved = optics_of(radius_m), planar = optics_of(0);
  for (const double x : {-0.19, -0.05, 0.0, 0.12, 0.19}) {
    for (const double z : {-0.3, -0.01, 0.0, 0.2, 0.6}) {
      const Point3<Physical> p{x, 0.03, z};
      const auto on_curved = on_screen(curved, kEmitter, p), on_planar = on_screen(planar, kEmitter, p);
      if (!on_curved || !on_planar) {
        worst.take(kInfinity);
        continue;
      }
      worst.take(std::hypot(on_curved->at.x - on_planar->at.x, on_curved->at.y - on_planar->at.y));
      worst.take(on_curved->depth - on_planar->depth);
      worst.take(on_curved->w - on_planar->w);
    }
  }
}

StabilityCase arc_refused(double radius_m) {
  return refused(kGroup, fmt::format("{:g} m, observers on an arc behind its axis", radius_m), "observer_arc",
                 [radius_m] { return validate(optics_of(radius_m, true)); });
}

}  // namespace

void add_radius_cases(StabilityCases& cases) {
  for (const double sign : {1.0, -1.0}) {
    for (const double size : {1e-2, 1e-1, 1.0, 2.0, 1e2, 1e4, 1e6, 1e9}) {
      const double radius_m = sign * size;
      cases.push_back(bounded(
          kGroup, fmt::format("{:g} m: points of lines by the circle's angles", radius_m), 16,
          "roundings at 1 m, magnified by the map",
          [radius_m](Worst& worst) { against_circles(worst, optics_of(radius_m)); }, 16));
      // Behind the axis of a concave screen there is no arc; between the axis and twice as far rays that light the
      // screen miss it.
      if (radius_m > -2 * kObserver && radius_m < 0) {
        if (radius_m >= -kObserver) cases.push_back(arc_refused(radius_m));
      } else {
        cases.push_back(bounded(
            kGroup, fmt::format("{:g} m, observers on the arc: the same", radius_m), 16,
            "roundings at 1 m, magnified by the map",
            [radius_m](Worst& worst) { against_circles(worst, optics_of(radius_m, true)); }, 16));
      }
      for (const double ez : {-1e2, -1e4, -1e6}) {
        if (size < 1) break;
        cases.push_back(bounded(
            kGroup, fmt::format("{:g} m, emitter {:g} m behind it: the same", radius_m, -ez), 16,
            "roundings at 1 m, magnified by the map",
            [=](Worst& worst) {
              against_circles(worst, optics_of(radius_m), {-0.05, 0.02, ez});
            },
            16));
      }
      if (size < 1e4) continue;
      const double bound = 1 / size + 64 * kEpsilon;
      cases.push_back(bounded(kGroup, fmt::format("{:g} m: joins the planar screen", radius_m), bound,
                              "m from the planar map: 1 m^2 / radius and rounding",
                              [radius_m](Worst& worst) { against_plane(worst, radius_m); }));
    }
  }
  cases.push_back(refused(kGroup, "not a number", "screen_radius_m",
                          [] { return validate(optics_of(std::numeric_limits<double>::quiet_NaN())); }));
  cases.push_back(refused(kGroup, "infinite", "screen_radius_m", [] { return validate(optics_of(kInfinity)); }));
  cases.push_back(refused(kGroup, "conical on a cylinder", "CONICAL on a curved screen", [] {
    Optics optics = optics_of(1);
    optics.diffuser = Diffuser::kConical;
    return validate(optics);
  }));
}

}  // namespace lfd::bench
