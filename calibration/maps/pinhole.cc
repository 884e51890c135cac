// The pinhole map forward, and backward by solving.
#include "calibration/maps/pinhole.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <tuple>

#include "calibration/limits.h"

namespace lfd {

glm::dmat3 module_from_physical_rotation(const PinholeMap& map) {
  const glm::dmat3 physical_from_turned = glm::mat3_cast(glm::normalize(map.orientation));
  glm::dmat3 rotation = glm::transpose(physical_from_turned);
  for (int column = 0; column < 3; ++column) rotation[column].y = -rotation[column].y;
  return rotation;
}

glm::dvec2 distort(const PinholeMap& m, glm::dvec2 a) {
  const double r2 = glm::dot(a, a);
  const double radial = 1 + r2 * (m.k1 + r2 * (m.k2 + r2 * m.k3));
  return a * radial + glm::dvec2(2 * m.p1 * a.x * a.y + m.p2 * (r2 + 2 * a.x * a.x),
                                 m.p1 * (r2 + 2 * a.y * a.y) + 2 * m.p2 * a.x * a.y);
}

namespace {

glm::dmat2 distort_jacobian(const PinholeMap& m, glm::dvec2 a) {
  const double r2 = glm::dot(a, a);
  const double radial = 1 + r2 * (m.k1 + r2 * (m.k2 + r2 * m.k3));
  const double slope = 2 * (m.k1 + r2 * (2 * m.k2 + r2 * 3 * m.k3));  // d radial / d r2, times 2
  const double xx = radial + slope * a.x * a.x + 2 * m.p1 * a.y + 6 * m.p2 * a.x;
  const double yy = radial + slope * a.y * a.y + 6 * m.p1 * a.y + 2 * m.p2 * a.x;
  const double xy = slope * a.x * a.y + 2 * m.p1 * a.x + 2 * m.p2 * a.y;
  return {{xx, xy}, {xy, yy}};
}

// d/dr of r (1 + k1 r^2 + k2 r^4 + k3 r^6) at q = r^2.
double radial_slope(const PinholeMap& m, double q) { return 1 + q * (3 * m.k1 + q * (5 * m.k2 + q * 7 * m.k3)); }

// Where the slope has its extremes, ascending: the positive roots of 3 k1 + 10 k2 q + 21 k3 q^2, infinity for those it
// lacks.
std::array<double, 2> slope_extremes(const PinholeMap& m) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double a = 21 * m.k3, b = 10 * m.k2, c = 3 * m.k1;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return {kNone, kNone};
  const double half = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  const auto root = [](double numerator, double denominator) {
    const double q = numerator / denominator;
    return q > 0 ? q : kNone;  // NaN of 0/0 is none, too
  };
  const double first = root(c, half), second = root(half, a);
  return {std::min(first, second), std::max(first, second)};
}

// Whether the radial polynomial grows all the way to r^2 = q.
bool grows_up_to(const PinholeMap& m, double q) {
  if (!(radial_slope(m, q) > 0)) return false;
  const auto extremes = slope_extremes(m);
  return std::all_of(extremes.begin(), extremes.end(), [&](double e) { return e > q || radial_slope(m, e) > 0; });
}

// Newton with halved steps wherever a full one does not bring the residual down or leaves the region that can be
// inverted.
std::optional<glm::dvec2> undistort(const PinholeMap& m, glm::dvec2 wanted) {
  if (m.k1 == 0 && m.k2 == 0 && m.k3 == 0 && m.p1 == 0 && m.p2 == 0) return wanted;
  if (!std::isfinite(wanted.x) || !std::isfinite(wanted.y)) return std::nullopt;
  glm::dvec2 a = wanted;
  while (!grows_up_to(m, glm::dot(a, a))) {
    a *= 0.5;
    if (!(glm::length(a) > 0)) return std::nullopt;
  }
  double residual = glm::length(distort(m, a) - wanted);
  const double enough = 1e-15 * (1 + glm::length(wanted));
  for (int iteration = 0; iteration < 60 && residual > enough; ++iteration) {
    const glm::dmat2 jacobian = distort_jacobian(m, a);
    const glm::dvec2 step = glm::inverse(jacobian) * (wanted - distort(m, a));
    double fraction = 1;
    for (; fraction > 1e-6; fraction *= 0.5) {
      const glm::dvec2 candidate = a + fraction * step;
      const double candidate_residual = glm::length(distort(m, candidate) - wanted);
      if (candidate_residual < residual && grows_up_to(m, glm::dot(candidate, candidate))) {
        std::tie(a, residual) = std::tuple(candidate, candidate_residual);
        break;
      }
    }
    if (!(fraction > 1e-6)) break;
  }
  if (!(residual <= 1000 * enough) || !(glm::determinant(distort_jacobian(m, a)) > 0)) return std::nullopt;
  return a;
}

}  // namespace

Status validate(const PinholeMap& map) {
  for (const auto& [name, place] : {std::pair{"position: x", map.position.x}, std::pair{"position: y", map.position.y},
                                    std::pair{"position: z", map.position.z}}) {
    if (!std::isfinite(place)) return Error(fmt::format("{}: {} must be finite", name, place));
    LFD_TRY_STATUS(check_magnitude(name, place, kPlace_m));
  }
  for (const auto& [name, value] : {std::pair{"focal_u_px", map.focal_u_px}, std::pair{"focal_v_px", map.focal_v_px}}) {
    if (!(value > 0) || !std::isfinite(value))
      return Error(fmt::format("{}: {} must be positive and finite", name, value));
    LFD_TRY_STATUS(check_magnitude(name, value, kFocalLength_px));
  }
  for (const auto& [name, value, limits] : {std::tuple{"principal_u_px", map.principal_u_px, kPlace_px},
                                            {"principal_v_px", map.principal_v_px, kPlace_px},
                                            {"k1", map.k1, kDistortion},
                                            {"k2", map.k2, kDistortion},
                                            {"k3", map.k3, kDistortion},
                                            {"p1", map.p1, kDistortion},
                                            {"p2", map.p2, kDistortion}}) {
    if (!std::isfinite(value)) return Error(fmt::format("{}: must be finite", name));
    LFD_TRY_STATUS(check_magnitude(name, value, limits));
  }
  const double norm = glm::length(map.orientation);
  if (!(std::abs(norm - 1) <= kUnitLengthError)) {
    return Error(fmt::format("orientation: a unit quaternion is needed (its length within {:g} of 1), its length is {}",
                             kUnitLengthError, norm));
  }
  return {};
}

double distortion_limit(const PinholeMap& m) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // Between its extremes the slope is monotonic: the first end at which it is not positive has the root before it.
  double low = 0;
  double high = kInfinity;
  for (const double extreme : slope_extremes(m)) {
    if (!std::isfinite(extreme)) break;
    if (!(radial_slope(m, extreme) > 0)) {
      high = extreme;
      break;
    }
    low = extreme;
  }
  if (!std::isfinite(high)) {
    const double leading = m.k3 != 0 ? m.k3 : m.k2 != 0 ? m.k2 : m.k1;
    if (leading >= 0) return kInfinity;
    high = std::max(1.0, 2 * low);
    while (radial_slope(m, high) > 0) high *= 2;
    if (!std::isfinite(high)) return kInfinity;
  }
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    (radial_slope(m, middle) > 0 ? low : high) = middle;
  }
  return std::sqrt(low);
}

double corner_radius(const PinholeMap& map, ImageSize image) {
  const glm::dvec2 principal(map.principal_u_px, map.principal_v_px), focal(map.focal_u_px, map.focal_v_px);
  double radius = 0;
  for (const double u : {0.0, double(image.width)}) {
    for (const double v : {0.0, double(image.height)})
      radius = std::max(radius, glm::length((glm::dvec2(u, v) - principal) / focal));
  }
  return radius;
}

std::optional<PixelPoint> image_from_point(const PinholeMap& map, Point3<Physical> point) {
  const glm::dvec3 q = module_from_physical_rotation(map) * to_glm(point - map.position);
  if (!(q.z > 0)) return std::nullopt;
  const glm::dvec2 a = glm::dvec2(q) / q.z;
  if (!grows_up_to(map, glm::dot(a, a)) || !(glm::determinant(distort_jacobian(map, a)) > 0)) return std::nullopt;
  const glm::dvec2 distorted = distort(map, a);
  const PixelPoint p{map.focal_u_px * distorted.x + map.principal_u_px,
                     map.focal_v_px * distorted.y + map.principal_v_px};
  if (!is_finite(p)) return std::nullopt;
  return p;
}

std::optional<Vector3<Physical>> direction_of_pixel(const PinholeMap& map, PixelPoint p) {
  const auto a =
      undistort(map, {(p.x - map.principal_u_px) / map.focal_u_px, (p.y - map.principal_v_px) / map.focal_v_px});
  if (!a) return std::nullopt;
  return vector_of<Physical>(glm::transpose(module_from_physical_rotation(map)) * glm::dvec3(*a, 1));
}

std::optional<PixelPoint> image_from_screen(const PinholeMap& map, ScreenPoint s) {
  return image_from_point(map, {s.x, s.y, 0});
}

std::optional<ScreenPoint> screen_from_image(const PinholeMap& map, PixelPoint p) {
  const auto direction = direction_of_pixel(map, p);
  if (!direction) return std::nullopt;
  const double distance = -map.position.z / direction->z;  // to the plane z = 0
  if (!(distance > 0)) return std::nullopt;
  const ScreenPoint s{map.position.x + distance * direction->x, map.position.y + distance * direction->y};
  if (!is_finite(s)) return std::nullopt;
  return s;
}

}  // namespace lfd
