// Judging.
#include "bench/stability/picture_bounds.h"

#include "base/log.h"
#include "bench/stability/color_truth.h"

namespace lfd::bench {

std::string text_of(const PictureBounds& bounds) {
  std::string text = fmt::format("of the ROI diagonal: median {:g}, 99.9 % {:g}, max {:g}", bounds.median,
                                 bounds.percent_999, bounds.max);
  if (bounds.most_far_off > 0)
    text += fmt::format(" but for {} pixels beyond {:g}", bounds.most_far_off, reference::kFarOff);
  text += fmt::format("; coverage differs by {:g}; colours within {} of 255; all finite", bounds.mismatch_share,
                      kColorTolerance);
  return bounds.why.empty() ? text : text + " (" + bounds.why + ")";
}

std::vector<std::string> broken_bounds(const reference::Truth& truth, const PictureBounds& bounds) {
  std::vector<std::string> broken;
  const auto check = [&](const char* name, double value, double bound) {
    if (!(value <= bound)) broken.push_back(fmt::format("{} above {:g}", name, bound));
  };
  check("median", truth.median, bounds.median);
  check("99.9 %", truth.percent_999, bounds.percent_999);
  if (truth.far_off > bounds.most_far_off) broken.push_back(fmt::format("{} pixels far off", truth.far_off));
  if (!(truth.max <= bounds.max)) {
    broken.push_back(fmt::format("max above {:g}, at pixel {}, {}", bounds.max, truth.worst.column, truth.worst.row));
  }
  check("coverage", truth.mismatch_share, bounds.mismatch_share);
  const std::size_t with_surface = truth.in_both + truth.only_in_reference;
  if (static_cast<double>(truth.compared) < bounds.least_compared_share * static_cast<double>(with_surface) ||
      truth.compared < bounds.least_compared) {
    broken.push_back(fmt::format("only {} of {} pixels compared", truth.compared, with_surface));
  }
  return broken;
}

}  // namespace lfd::bench
