// Bytes over time as an SVG picture, with what is lost written beside each encoding.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/log.h"
#include "bench/stream/stream_bench.h"
#include "cli/plots/svg.h"

namespace lfd::bench {
namespace {

constexpr double kWidth = 820, kHeight = 520, kLeft = 80, kRight = 40, kTop = 50, kBottom = 60;
constexpr const char* kGrid = "#dddddd";

// A logarithmic axis.
struct Axis {
  double low, high;  // decades
  double from_px, to_px;
  double at(double value) const {
    return from_px + (std::log10(std::max(value, 1e-9)) - low) / (high - low) * (to_px - from_px);
  }
};

double time_ms(const CodecRow& row) { return std::max(row.encode_ms.median + row.decode_ms.median, 0.1); }
double bytes_per_pixel(const CodecRow& row) {
  return 4 * static_cast<double>(row.bytes) / static_cast<double>(row.pixel_bytes);
}

void draw_grid(plots::Svg& svg, const Axis& x, const Axis& y) {
  constexpr std::array kSteps{1.0, 2.0, 5.0};
  for (double decade = -4; decade <= 5; ++decade) {
    for (const double step : kSteps) {
      const double value = step * std::pow(10, decade);
      if (const double at = x.at(value); at >= x.from_px && at <= x.to_px) {
        svg.line({at, y.from_px}, {at, y.to_px}, {.stroke = kGrid});
        svg.text({at, y.from_px + 18}, fmt::format("{:g}", value), {.anchor = plots::Anchor::kMiddle});
      }
      if (const double at = y.at(value); at <= y.from_px && at >= y.to_px) {
        svg.line({x.from_px, at}, {x.to_px, at}, {.stroke = kGrid});
        svg.text({x.from_px - 6, at + 4}, fmt::format("{:g}", value), {.anchor = plots::Anchor::kEnd});
      }
    }
  }
}

}  // namespace

std::string svg_of(const StreamTable& table, const std::string& scene) {
  double fastest = 1, slowest = 1, least = 1, most = 4;
  for (const CodecRow& row : table.rows) {
    if (row.scene != scene || row.buffer != "color") continue;
    fastest = std::min(fastest, time_ms(row));
    slowest = std::max(slowest, time_ms(row));
    least = std::min(least, bytes_per_pixel(row));
    most = std::max(most, bytes_per_pixel(row));
  }
  const Axis x{std::log10(fastest) - 0.1, std::log10(slowest) + 0.6, kLeft, kWidth - kRight};
  const Axis y{std::log10(least) - 0.1, std::log10(most) + 0.1, kHeight - kBottom, kTop};
  plots::Svg svg(kWidth, kHeight);
  draw_grid(svg, x, y);
  svg.text({kLeft, 24}, fmt::format("Bytes over time of encodings: colours of {} on {}", scene, table.display),
           {.size_px = 15, .is_bold = true});
  svg.text({0.5 * (x.from_px + x.to_px), kHeight - 18}, "encoding and decoding one image, ms, one thread",
           {.anchor = plots::Anchor::kMiddle});
  svg.text({22, 0.5 * (y.from_px + y.to_px)}, "bytes per pixel",
           {.anchor = plots::Anchor::kMiddle, .is_upright = true});
  for (const CodecRow& row : table.rows) {
    if (row.scene != scene || row.buffer != "color") continue;
    const plots::Place at{x.at(time_ms(row)), y.at(bytes_per_pixel(row))};
    svg.circle(at, 5, {.fill = row.psnr_db ? "#d62728" : "#1f77b4"});
    const std::string lost = row.psnr_db ? fmt::format(": {:.1f} dB", *row.psnr_db) : "";
    svg.text({at.x + 8, at.y + 4}, row.codec + lost, {});
  }
  return svg.finish();
}

}  // namespace lfd::bench
