// The pinholes near a start, by fifteen numbers that are 0 at the start and 1 at one standard deviation from it.
#pragma once

#include <ceres/rotation.h>

#include <array>
#include <optional>

#include "calibration/maps/pinhole.h"
#include "calibration/spaces/pixel.h"

namespace lfd {

inline constexpr int kPinholeParameters = 15;
using PinholeVector = std::array<double, kPinholeParameters>;

// Names of the parameters, in the order of the numbers.
inline constexpr std::array<const char*, kPinholeParameters> kPinholeParameterNames{
    "position x", "position y",     "position z",     "turn about x", "turn about y", "turn about z", "focal_u_px",
    "focal_v_px", "principal_u_px", "principal_v_px", "k1",           "k2",           "k3",           "p1",
    "p2"};

// Position moves along the physical axes, the orientation turns about the start module's own, focal lengths grow by
// factors of e, everything else is added.
class PinholeFamily {
 public:
  // position_sd_m: how well the position is known, > 0. The other standard deviations are generous for an installation
  // by hand: 1 degree for each turn, 2 % of the focal lengths, 3 % of the image's width for the principal point, and
  // for each coefficient of the lens what moves the corner of the image furthest from the axis by 3 % (k1, p1, p2), 2 %
  // (k2), 1 % (k3) of the image's width.
  PinholeFamily(const PinholeMap& start, ImageSize image, double position_sd_m);

  PinholeMap at(const PinholeVector& z) const;

  // In the unit of the parameter: m, rad, log of px, px, 1.
  const PinholeVector& standard_deviation() const { return sd_; }

  // Where the pinhole `z` sees the point (s, y) of a screen of the given curvature (1 / radius, 1/m; 0: planar). False
  // where that is not before the pinhole. T: double or a ceres::Jet. Unlike image_from_screen it also answers where the
  // lens has turned back: a solver on its way must not fall off an edge.
  template <class T>
  bool project(const T* z, const T& curvature, const T& s, const T& y, T* uv) const;

 private:
  PinholeMap start_;
  std::array<double, 9> start_rotation_;  // row-major: turned module, its y not yet mirrored, from physical
  PinholeVector sd_;
};

namespace detail {

// sin(h) / h, with its derivative, also near 0.
template <class T>
T sinc(const T& h) {
  using std::abs;
  using std::sin;
  if (abs(h) > 1e-2) return sin(h) / h;
  const T q = h * h;
  return 1.0 - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0));  // the rest is below 1e-19
}

}  // namespace detail

template <class T>
bool PinholeFamily::project(const T* z, const T& curvature, const T& s, const T& y, T* uv) const {
  using std::cos;
  using std::exp;
  using std::sin;
  const auto of = [&](std::size_t i) -> T { return z[i] * sd_[i]; };
  const T half_angle = 0.5 * curvature * s;  // CurvedScreen::point_at
  const T chord = s * detail::sinc(half_angle);
  const T from[3] = {chord * cos(half_angle) - start_.position.x - of(0), y - start_.position.y - of(1),
                     -chord * sin(half_angle) - start_.position.z - of(2)};
  T in_start[3];
  for (std::size_t row = 0; row < 3; ++row) {
    const double* const r = &start_rotation_[3 * row];
    in_start[row] = r[0] * from[0] + r[1] * from[1] + r[2] * from[2];
  }
  const T turn[3] = {-of(3), -of(4), -of(5)};
  T q[3];
  ceres::AngleAxisRotatePoint(turn, in_start, q);
  if (!(q[2] > 0.0)) return false;
  const T ax = q[0] / q[2], ay = -q[1] / q[2];
  const T k1 = start_.k1 + of(10), k2 = start_.k2 + of(11), k3 = start_.k3 + of(12);
  const T p1 = start_.p1 + of(13), p2 = start_.p2 + of(14);
  const T r2 = ax * ax + ay * ay;
  const T radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const T x = ax * radial + 2.0 * p1 * ax * ay + p2 * (r2 + 2.0 * ax * ax);
  const T v = ay * radial + p1 * (r2 + 2.0 * ay * ay) + 2.0 * p2 * ax * ay;
  uv[0] = start_.focal_u_px * exp(of(6)) * x + start_.principal_u_px + of(8);
  uv[1] = start_.focal_v_px * exp(of(7)) * v + start_.principal_v_px + of(9);
  return true;
}

}  // namespace lfd
