// Pinholes whose distortion turns back inside the image, is violent, or is almost none.
#include <cmath>
#include <limits>

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

// Wherever a pixel has a screen point, the map leads back to the pixel: in pixels.
void inverse(Worst& worst, const PinholeMap& map) {
  for (double u = 0.5; u < 256; u += 2.3) {
    for (double v = 0.5; v < 192; v += 2.1) {
      const auto s = screen_from_image(map, {u, v});
      if (!s) continue;
      const auto p = image_from_screen(map, *s);
      worst.take(p ? std::hypot(p->x - u, p->y - v) : kInfinity);
    }
  }
}

// And wherever a screen point has a pixel, only one has: the answers are in the order of the screen.
std::string turns_back(const PinholeMap& map) {
  for (double angle = 0; angle < 6.28; angle += 0.37) {
    double last = -1;
    for (double radius = 0; radius < 0.6; radius += 0.003) {
      const auto p = image_from_screen(map, {radius * std::cos(angle), radius * std::sin(angle)});
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
  const std::pair<const char*, PinholeMap> lenses[] = {
      {"none", lens(0)},
      {"barrel, turns back in the corners (k1 = -2.2)", lens(-2.2)},
      {"barrel, turns back in mid-image (k1 = -10)", lens(-10)},
      {"barrel of 1e6", lens(-1e6)},
      {"turns back and forth again (k1 = -6, k2 = 25)", lens(-6, 25)},
      {"turns back by k3 alone (k3 = -200)", lens(0, 0, -200)},
      {"almost turns back (k1 = -4, k2 = 7.21)", lens(-4, 7.21)},
      {"pincushion of 1e3", lens(1e3)},
      {"tangential, turns back sideways (p1 = 0.8, p2 = -0.6)", lens(0, 0, 0, 0.8, -0.6)},
      {"all coefficients 1e-300", lens(1e-300, 1e-300, 1e-300, 1e-300, 1e-300)},
      {"all coefficients 1e300", lens(1e300, 1e300, 1e300, 1e300, 1e300)},
      {"coefficients of -1e300", lens(-1e300, -1e300, -1e300)},
  };
  for (const auto& [name, map] : lenses) {
    cases.push_back(bounded(kGroup, std::string(name) + ": pixels there and back", 1e-9,
                            "px: Newton ends within 1e-12 relative", [map = map](Worst& worst) {
                              inverse(worst, map);
                              worst.take(0);  // a lens that lights nothing is no fault
                            }));
    if (map.p1 != 0) continue;  // a tangential lens moves points sideways; along a ray nothing is promised
    cases.push_back(faultless(kGroup, std::string(name) + ": no pixel beyond the turn",
                              "pixels outward as screen points go outward", [map = map] { return turns_back(map); }));
  }
  for (const double k1 : {-0.5, -2.2, -10.0, -1e6}) {
    cases.push_back(bounded(kGroup, fmt::format("k1 = {:g}: where it turns back", k1), 1e-12,
                            "relative, of the closed form sqrt(-1 / 3 k1)",
                            [k1](Worst& worst) { limit_of_k1(worst, k1); }));
  }
}

}  // namespace lfd::bench
