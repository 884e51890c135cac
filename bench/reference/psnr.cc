// Mean square error to decibels.
#include "bench/reference/psnr.h"

#include <cmath>
#include <limits>

#include "base/check.h"

namespace lfd::reference {

double psnr_db(const Picture8& a, const Picture8& b, int border_px) {
  LFD_CHECK(a.width == b.width && a.height == b.height, "pictures of one size");
  LFD_CHECK(border_px >= 0 && 2 * border_px < a.width && 2 * border_px < a.height, "the border leaves pixels");
  double squares = 0;
  for (int row = border_px; row < a.height - border_px; ++row) {
    for (int column = border_px; column < a.width - border_px; ++column) {
      const std::size_t pixel = 4 * (static_cast<std::size_t>(row) * a.width + column);
      for (std::size_t i = pixel; i < pixel + 3; ++i) {
        const double difference = static_cast<double>(a.rgba[i]) - b.rgba[i];
        squares += difference * difference;
      }
    }
  }
  if (squares == 0) return std::numeric_limits<double>::infinity();
  const double values = 3.0 * (a.width - 2 * border_px) * (a.height - 2 * border_px);
  return 10 * std::log10(255.0 * 255.0 * values / squares);
}

}  // namespace lfd::reference
