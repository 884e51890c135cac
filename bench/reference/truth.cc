// Positions against hits.
#include "bench/reference/truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.h"

namespace lfd::reference {
namespace {

// The least value that at least `share` of all are not above. `sorted` is not empty.
double nearest_rank(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

double error_of(Point3<World> rendered, Point3<World> reference, double roi_diagonal_m) {
  const double error = length(rendered - reference) / roi_diagonal_m;
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

}  // namespace

Truth compare(const HitImage& reference, std::span<const std::uint8_t> near_silhouette, const PictureF& rendered,
              Point3<World> position_origin, double roi_diagonal_m) {
  const std::size_t pixels = reference.hit.size();
  LFD_CHECK(rendered.width == reference.size.width && rendered.height == reference.size.height &&
                near_silhouette.size() == pixels,
            "pictures of one size");
  LFD_CHECK(roi_diagonal_m > 0, "the region of interest has a size");
  Truth truth;
  std::vector<double> errors;
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* rgba = &rendered.rgba[4 * i];
    const bool is_drawn = rgba[3] > 0.5F;
    const auto& hit = reference.hit[i];
    truth.only_in_reference += hit && !is_drawn;
    truth.only_in_rendered += !hit && is_drawn;
    if (!hit || !is_drawn) continue;
    ++truth.in_both;
    if (near_silhouette[i] != 0) {
      ++truth.near_silhouette;
      continue;
    }
    const double error =
        error_of(position_origin + Vector3<World>{rgba[0], rgba[1], rgba[2]}, hit->world, roi_diagonal_m);
    if (errors.empty() || error > truth.max) {
      truth.max = error;
      truth.worst = {static_cast<int>(i % reference.size.width), static_cast<int>(i / reference.size.width)};
    }
    errors.push_back(error);
    truth.far_off += error > kFarOff;
  }
  truth.compared = errors.size();
  std::ranges::sort(errors);
  if (!errors.empty()) {
    truth.median = nearest_rank(errors, 0.5);
    truth.percent_99 = nearest_rank(errors, 0.99);
    truth.percent_999 = nearest_rank(errors, 0.999);
  }
  const std::size_t in_one = truth.only_in_reference + truth.only_in_rendered, in_any = in_one + truth.in_both;
  if (in_any > 0) truth.mismatch_share = static_cast<double>(in_one) / static_cast<double>(in_any);
  return truth;
}

std::vector<std::string> broken_bounds(const Truth& truth, const TruthBounds& bounds) {
  std::vector<std::string> broken;
  const auto check = [&](const char* name, double value, double bound) {
    if (!(value <= bound)) broken.push_back(fmt::format("{}: {:.3g}, at most {:.3g} is allowed", name, value, bound));
  };
  check("median error / ROI diagonal", truth.median, bounds.median);
  check("99 % error / ROI diagonal", truth.percent_99, bounds.percent_99);
  check("largest error / ROI diagonal", truth.max, bounds.max);
  check("share of pixels with a surface in only one", truth.mismatch_share, bounds.mismatch_share);
  const std::size_t with_surface = truth.in_both + truth.only_in_reference;
  if (static_cast<double>(truth.compared) < bounds.least_compared_share * static_cast<double>(with_surface)) {
    broken.push_back(fmt::format("compared: {} of {} pixels with a surface, a share of {} is needed", truth.compared,
                                 with_surface, bounds.least_compared_share));
  }
  return broken;
}

}  // namespace lfd::reference
