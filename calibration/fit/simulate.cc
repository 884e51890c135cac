// Points over every module's image, looked up in the true map, then spoilt.
#include "calibration/fit/simulate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/log.h"
#include "calibration/random.h"

namespace lfd {
namespace {

constexpr double kLeastDisplacement_px = 10, kMostDisplacement_px = 40;

// A part of the image that is not seen.
struct MissingArea {
  bool is_disc = false;
  PixelPoint middle;
  double half_width_px = 0, half_height_px = 0;

  bool contains(PixelPoint p) const {
    const double x = (p.x - middle.x) / half_width_px, y = (p.y - middle.y) / half_height_px;
    return is_disc ? x * x + y * y < 1 : std::abs(x) < 1 && std::abs(y) < 1;
  }
};

// Of `share` of the image's area, all within the image: a rectangle, or a disc where one of that size fits.
MissingArea missing_area(ImageSize image, double share, Random& random) {
  MissingArea area;
  const double area_px2 = share * image.width * image.height;
  const double radius_px = std::sqrt(area_px2 / std::numbers::pi);
  area.is_disc = random.unit() < 0.5 && 2 * radius_px <= std::min(image.width, image.height);
  if (area.is_disc) {
    area.half_width_px = area.half_height_px = radius_px;
    area.middle = {radius_px + random.unit() * (image.width - 2 * radius_px),
                   radius_px + random.unit() * (image.height - 2 * radius_px)};
  } else {
    // Neither side beyond the image's: the form is chosen between those limits.
    const double least = share * image.width, width = least + random.unit() * (image.width - least);
    area.half_width_px = 0.5 * width;
    area.half_height_px = 0.5 * area_px2 / width;
    area.middle = {area.half_width_px + random.unit() * (image.width - width),
                   area.half_height_px + random.unit() * (image.height - 2 * area.half_height_px)};
  }
  return area;
}

// A place in the image made from `p` by `move`, which is drawn until it stays inside; p itself where it never does.
template <class Move>
PixelPoint moved_within(ImageSize image, PixelPoint p, Move move) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    const PixelPoint moved = move(p);
    if (contains(image, moved)) return moved;
  }
  return p;
}

Status check_options(const DisplayCalibration& display, const SimulationOptions& options) {
  const double most_noise = 0.25 * std::min(display.image.width, display.image.height);
  if (!(options.noise_px >= 0 && options.noise_px <= most_noise)) {
    return Error(fmt::format("noise: {} px; 0 to {} are possible", options.noise_px, most_noise));
  }
  for (const auto& [name, share] : {std::pair{"outliers", options.outliers}, std::pair{"missing", options.missing}}) {
    if (!(share >= 0 && share <= 1)) return Error(fmt::format("{}: {}; a share of 0 to 1 is needed", name, share));
  }
  for (const int count : {options.points_u, options.points_v}) {
    if (count < 2 || count > kMaxGridSide) {
      return Error(fmt::format("points: {} along a side; 2 to {} are possible", count, kMaxGridSide));
    }
  }
  const auto all =
      static_cast<std::size_t>(options.points_u) * static_cast<std::size_t>(options.points_v) * display.modules.size();
  if (all > kMaxObservations) return Error(fmt::format("points: {} in all; at most {}", all, kMaxObservations));
  if (options.write_sigma && options.noise_px < kLeastSigma_px) {
    return Error(fmt::format("noise: {} px; a sigma is at least {} px", options.noise_px, kLeastSigma_px));
  }
  return {};
}

}  // namespace

Result<SimulatedObservations> simulate_observations(const DisplayCalibration& display,
                                                    const SimulationOptions& options) {
  LFD_TRY_STATUS(check_options(display, options));
  Random random(options.seed);
  const auto noisy = [&](PixelPoint p) {
    const double u = random.normal_with_tails(), v = random.normal_with_tails();
    return PixelPoint{p.x + options.noise_px * u, p.y + options.noise_px * v};
  };
  const auto displaced = [&](PixelPoint p) {
    const double angle = 2 * std::numbers::pi * random.unit();
    const double by = kLeastDisplacement_px + (kMostDisplacement_px - kLeastDisplacement_px) * random.unit();
    return PixelPoint{p.x + by * std::cos(angle), p.y + by * std::sin(angle)};
  };
  SimulatedObservations made;
  made.observations.has_sigma = options.write_sigma;
  auto& points = made.observations.points;
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    const MissingArea missing = missing_area(display.image, options.missing, random);
    for (int j = 0; j < options.points_v; ++j) {
      for (int i = 0; i < options.points_u; ++i) {
        const PixelPoint p{(i + 0.5) / options.points_u * display.image.width,
                           (j + 0.5) / options.points_v * display.image.height};
        const auto s = screen_from_image(display, display.modules[k], p);
        if (!s || (options.missing > 0 && missing.contains(p))) continue;
        const PixelPoint struck = random.unit() < options.outliers ? moved_within(display.image, p, displaced) : p;
        if (struck != p) made.outliers.push_back(points.size());
        const PixelPoint seen = moved_within(display.image, struck, noisy);
        // The header is line 1.
        points.push_back(
            {static_cast<int>(k), seen, *s, options.write_sigma ? options.noise_px : 1, points.size() + 2});
      }
    }
  }
  return made;
}

}  // namespace lfd
