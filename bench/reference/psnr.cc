// Mean square error to decibels.
#include "bench/reference/psnr.h"

#include <cmath>
#include <limits>

#include "base/check.h"

namespace lfd::reference {

double psnr_db(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b, ImageSize size, int border_px) {
  const std::size_t bytes = std::size_t{4} * size.width * size.height;
  LFD_CHECK(a.size() == bytes && b.size() == bytes, "both are RGBA pictures of the stated size");
  LFD_CHECK(border_px >= 0 && 2 * border_px < size.width && 2 * border_px < size.height, "the border leaves pixels");
  double squares = 0;
  for (int row = border_px; row < size.height - border_px; ++row) {
    for (int column = border_px; column < size.width - border_px; ++column) {
      const std::size_t pixel = 4 * (static_cast<std::size_t>(row) * size.width + column);
      for (std::size_t i = pixel; i < pixel + 3; ++i) {
        const double difference = static_cast<double>(a[i]) - b[i];
        squares += difference * difference;
      }
    }
  }
  if (squares == 0) return std::numeric_limits<double>::infinity();
  const double values = 3.0 * (size.width - 2 * border_px) * (size.height - 2 * border_px);
  return 10 * std::log10(255.0 * 255.0 * values / squares);
}

}  // namespace lfd::reference
