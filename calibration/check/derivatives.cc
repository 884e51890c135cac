// Central differences of the maps.
#include "calibration/check/derivatives.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

#include "calibration/curved_screen.h"

namespace lfd {
namespace {

constexpr double kStep = 1e-6;  // as a share of the lengths at hand: rounding and curvature both stay below 1e-9

template <class M>
double frobenius(const M& m) {
  double sum = 0;
  for (int column = 0; column < m.length(); ++column) sum += glm::dot(m[column], m[column]);
  return std::sqrt(sum);
}

template <class M>
double condition(const M& m) {
  const double number = frobenius(m) * frobenius(glm::inverse(m)) / M::length();
  return std::isfinite(number) ? number : std::numeric_limits<double>::infinity();
}

// Metres on the screen, y up, of a position in the image of the ideal map.
glm::dvec2 on_ideal_screen(const DisplayCalibration& display, PixelPoint p) {
  const ScreenPoint s = screen_from_image(IdealMap{}, display.screen, display.image, p);
  return {s.x, s.y};
}

// (image, depth) in metres.
std::optional<glm::dvec3> scaled_image(const DisplayCalibration& display, const ModuleCalibration& module,
                                       glm::dvec3 p) {
  const auto seen = on_screen(display.optics, module.emitter, point_of<Physical>(p));
  if (!seen) return std::nullopt;
  const auto pixel = image_from_screen(display, module, seen->at);
  if (!pixel) return std::nullopt;
  return glm::dvec3(on_ideal_screen(display, *pixel), seen->depth);
}

}  // namespace

std::optional<glm::dmat2> derivative_by_screen(const DisplayCalibration& display, const ModuleCalibration& module,
                                               ScreenPoint s) {
  glm::dmat2 derivative;
  const glm::dvec2 step = kStep * glm::dvec2(display.screen.width_m, display.screen.height_m);
  for (int axis = 0; axis < 2; ++axis) {
    const glm::dvec2 d = axis == 0 ? glm::dvec2(step.x, 0) : glm::dvec2(0, step.y);
    const auto after = image_from_screen(display, module, {s.x + d.x, s.y + d.y});
    const auto before = image_from_screen(display, module, {s.x - d.x, s.y - d.y});
    if (!after || !before) return std::nullopt;
    derivative[axis] = (on_ideal_screen(display, *after) - on_ideal_screen(display, *before)) / (2 * step[axis]);
  }
  return derivative;
}

std::optional<glm::dmat3> derivative_by_physical(const DisplayCalibration& display, const ModuleCalibration& module,
                                                 Point3<Physical> p) {
  glm::dmat3 derivative;
  const double step = kStep * std::min({display.screen.width_m, -module.emitter.z, display.optics.observer_distance_m});
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 d(0.0);
    d[axis] = step;
    const auto after = scaled_image(display, module, to_glm(p) + d);
    const auto before = scaled_image(display, module, to_glm(p) - d);
    if (!after || !before) return std::nullopt;
    derivative[axis] = (*after - *before) / (2 * step);
  }
  return derivative;
}

double condition_number(const glm::dmat2& m) { return condition(m); }
double condition_number(const glm::dmat3& m) { return condition(m); }

std::optional<double> condition_at(const DisplayCalibration& display, const ModuleCalibration& module,
                                   Point3<Physical> p) {
  const auto derivative = derivative_by_physical(display, module, p);
  if (!derivative) return std::nullopt;
  return condition_number(*derivative);
}

Point3<Physical> point_before_screen(const Optics& optics, ScreenPoint s, double distance_m) {
  const Point3<Physical> on_surface = surface_point(optics, s);
  if (optics.screen_radius_m == 0) return {s.x, s.y, distance_m};
  const glm::dvec2 outward = CurvedScreen(optics.screen_radius_m).outward({on_surface.x, on_surface.z});
  return on_surface + distance_m * Vector3<Physical>{outward.x, 0, outward.y};
}

}  // namespace lfd
