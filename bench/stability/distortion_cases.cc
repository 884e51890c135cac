// Pinholes whose distortion turns back inside the image, is violent, or is almost none.
#include <cmath>
#include <limits>
#include <vector>

#include "base/log.h"
#include "bench/stability/groups.h"
#include "calibration/display.h"
#include "calibration/maps/pinhole.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "distortion";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// 256 x 192 pixels on a screen of 0.4 x 0.3 m from 0.6 m behind it; the corners are 0.42 from the axis.
PinholeMap lens(double k1, double k2 = 0, double k3 = 0, double p1 = 0, double p2 = 0) {
  PinholeMap map;
  map.position = {0, 0, -0.6};
  map.focal_u_px = map.focal_v_px = 384;
  map.principal_u_px = 128;
  map.principal_v_px = 96;
  map.k1 = k1;
  map.k2 = k2;
  map.k3 = k3;
  map.p1 = p1;
  map.p2 = p2;
  return map;
}

// The radius, in normalised coordinates, up to which the radial polynomial grows: the first root of its derivative
// 1 + 3 k1 r^2 + 5 k2 r^4 + 7 k3 r^6, by steps and bisection; `beyond` where there is none. An independent reference
// for distortion_limit().
double turn_of(const PinholeMap& map, double beyond) {
  const auto slope = [&](double r) { return 1 + r * r * (3 * map.k1 + r * r * (5 * map.k2 + r * r * 7 * map.k3)); };
  double low = 0;
  for (double high = 1e-6; high < beyond; low = high, high *= 1.0001) {
    if (slope(high) > 0) continue;
    double inside = low, outside = high;
    for (int i = 0; i < 60; ++i) {
      const double middle = (inside + outside) / 2;
      (slope(middle) > 0 ? inside : outside) = middle;
    }
    return inside;
  }
  return beyond;
}

// Places of pixels: even over the image, and on rays from the principal point out to where the distortion turns back.
std::vector<PixelPoint> places(double turn_px) {
  std::vector<PixelPoint> found;
  for (double u = 0.5; u < 256; u += 2.3) {
    for (double v = 0.5; v < 192; v += 2.1) found.push_back({u, v});
  }
  for (double angle = 0.1; angle < 6.28; angle += 0.37) {
    for (const double share : {1e-3, 0.1, 0.5, 0.9, 0.99, 0.999999}) {
      const double out = share * std::min(turn_px, 90.0);
      found.push_back({128 + out * std::cos(angle), 96 + out * std::sin(angle)});
    }
  }
  return found;
}

double radial(const PinholeMap& map, double r) {
  return r * (1 + r * r * (map.k1 + r * r * (map.k2 + r * r * map.k3)));
}

// Wherever a pixel has a screen point, the map leads back to the pixel: in pixels. Without tangential parts a pixel has
// one exactly within the distorted radius of the turn; `least_share` of all others must have one.
void inverse(Worst& worst, const PinholeMap& map, double least_share) {
  const bool is_radial = map.p1 == 0 && map.p2 == 0;
  const double turn_px = 384 * radial(map, turn_of(map, 10));
  std::size_t answers = 0;
  const std::vector<PixelPoint> pixels = places(is_radial ? turn_px : 90);
  for (const PixelPoint& pixel : pixels) {
    const double out = std::hypot(pixel.x - 128, pixel.y - 96);
    const auto s = screen_from_image(map, pixel);
    if (is_radial && std::abs(out / turn_px - 1) > 1e-7 && s.has_value() != (out < turn_px)) worst.take(kInfinity);
    if (!s) continue;
    ++answers;
    const auto p = image_from_screen(map, *s);
    worst.take(p ? std::hypot(p->x - pixel.x, p->y - pixel.y) : kInfinity);
  }
  if (static_cast<double>(answers) < least_share * static_cast<double>(pixels.size())) worst.take(kInfinity);
}

// A screen point has a pixel exactly up to the turn, and only one: the answers are in the order of the screen.
std::string turns_back(const PinholeMap& map) {
  const double turn_m = 0.6 * turn_of(map, 10);
  for (double angle = 0; angle < 6.28; angle += 0.37) {
    double last = -1;
    for (double share = 0; share < 1.5; share += 0.0041) {
      const double radius = share * std::min(turn_m, 0.4);
      const auto p = image_from_screen(map, {radius * std::cos(angle), radius * std::sin(angle)});
      if (p.has_value() != (radius < turn_m))
        return fmt::format("at {:.3g} m: {} a pixel; it turns back at {:.3g} m", radius, p ? "it has" : "without",
                           turn_m);
      if (!p) continue;
      const double out = (p->x - 128) * std::cos(angle) - (p->y - 96) * std::sin(angle);
      if (!(out > last)) return fmt::format("at {:.3f} m the image goes back", radius);
      last = out;
    }
  }
  return "";
}

// A screen point has a pixel exactly up to the radius where the derivative 1 + 3 k1 r^2 is zero.
void limit_of_k1(Worst& worst, double k1) {
  const double limit = std::sqrt(-1 / (3 * k1));
  worst.take((distortion_limit(lens(k1)) - limit) / limit);
  const PinholeMap map = lens(k1);
  if (!image_from_screen(map, {0.6 * limit * (1 - 1e-9), 0})) worst.take(kInfinity);
  if (image_from_screen(map, {0.6 * limit * (1 + 1e-9), 0})) worst.take(kInfinity);
}

}  // namespace

void add_distortion_cases(StabilityCases& cases) {
  struct Lens {
    const char* name;
    PinholeMap map;
    double least_share;  // of the pixels looked at that have a screen point; radial ones are known one by one
  };
  const Lens lenses[] = {
      {"none", lens(0), 1},
      {"barrel, turns back in the corners (k1 = -2.2)", lens(-2.2), 0.6},
      {"barrel, turns back in mid-image (k1 = -10)", lens(-10), 0.1},
      {"barrel of 1e6", lens(-1e6), 0.009},  // the rays alone
      {"turns back and forth again (k1 = -6, k2 = 25)", lens(-6, 25), 0.1},
      {"turns back by k3 alone (k3 = -200)", lens(0, 0, -200), 0.5},
      {"almost turns back (k1 = -4, k2 = 7.21)", lens(-4, 7.21), 1},
      {"pincushion of 1e3", lens(1e3), 1},
      {"pincushion of 1e6, the most that is accepted", lens(1e6), 1},
      {"tangential, turns back sideways (p1 = 0.8, p2 = -0.6)", lens(0, 0, 0, 0.8, -0.6), 0.3},
      {"all coefficients 1e-300", lens(1e-300, 1e-300, 1e-300, 1e-300, 1e-300), 1},
  };
  for (const auto& [name, map, least_share] : lenses) {
    cases.push_back(bounded(
        kGroup, std::string(name) + ": pixels there and back", 1e-9,
        fmt::format("px: Newton ends within 1e-12 relative; pixels within the turn, and at least {} of all, have an "
                    "answer",
                    least_share),
        [map = map, least_share = least_share](Worst& worst) { inverse(worst, map, least_share); }));
    if (map.p1 != 0) continue;  // a tangential lens moves points sideways; along a ray nothing is promised
    cases.push_back(faultless(kGroup, std::string(name) + ": screen points up to the turn",
                              "each has a pixel, outward in their order, and none beyond it",
                              [map = map] { return turns_back(map); }));
  }
  for (const double k : {1e300, -1e300}) {
    cases.push_back(
        refused(kGroup, fmt::format("coefficients of {:g}", k), "k1", [k] { return validate(lens(k, k, k, k, k)); }));
  }
  for (const double k1 : {-0.5, -2.2, -10.0, -1e6}) {
    cases.push_back(bounded(kGroup, fmt::format("k1 = {:g}: where it turns back", k1), 1e-12,
                            "relative, of the closed form sqrt(-1 / 3 k1)",
                            [k1](Worst& worst) { limit_of_k1(worst, k1); }));
  }
}

}  // namespace lfd::bench
