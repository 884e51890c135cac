// Ticks at round numbers.
#include "cli/plots/axes.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"

namespace lfd::plots {
namespace {

constexpr double kTick_px = 5;
const Pen kInk{.stroke = "#444444"};

int wanted_ticks(double length_px) { return std::clamp(static_cast<int>(length_px / 70), 3, 10); }

}  // namespace

std::vector<double> ticks_in(Range range, int wanted) {
  const double low = std::min(range.from, range.to), high = std::max(range.from, range.to);
  // Where the range is but rounding, numbers cannot be told apart.
  if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high))) || !std::isfinite(high - low)) return {};
  const double raw = (high - low) / wanted, decade = std::pow(10, std::floor(std::log10(raw)));
  const double share = raw / decade, step = decade * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
  std::vector<double> ticks;
  const double slack = 1e-9 * step;  // a tick on the border counts
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) {
    ticks.push_back(k == 0 ? 0 : k * step);  // not -0
  }
  return ticks;
}

Box with_equal_scales(const Box& box, Range x, Range y) {
  const double width = std::abs(x.to - x.from), height = std::abs(y.to - y.from);
  const double px_per_unit = std::min(box.width / width, box.height / height);
  const double w = width * px_per_unit, h = height * px_per_unit;
  return {box.x + (box.width - w) / 2, box.y, w, h};
}

double arrow_scale(double longest_px, double place_px) {
  if (!(longest_px > 1e-6)) return 1;  // nothing but rounding
  double scale = 1;
  for (double decade = 1; decade <= 1e6; decade *= 10) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (decade * step * longest_px <= 1.5 * place_px) scale = decade * step;
    }
  }
  return scale;
}

Place Axes::at(double x, double y) const {
  return {box_.x + (x - x_.from) / (x_.to - x_.from) * box_.width,
          box_.y + box_.height - (y - y_.from) / (y_.to - y_.from) * box_.height};
}

void Axes::draw_grid(Svg& svg) const {
  const Pen pale{.stroke = "#e6e6e6"};
  for (const double x : ticks_in(x_, wanted_ticks(box_.width))) svg.line(at(x, y_.from), at(x, y_.to), pale);
  for (const double y : ticks_in(y_, wanted_ticks(box_.height))) svg.line(at(x_.from, y), at(x_.to, y), pale);
}

void Axes::draw(Svg& svg, const Labels& labels) const {
  svg.rectangle(box_, kInk);
  const double bottom = box_.y + box_.height;
  for (const double x : ticks_in(x_, wanted_ticks(box_.width))) {
    const double place = at(x, y_.from).x;
    svg.line({place, bottom}, {place, bottom + kTick_px}, kInk);
    svg.text({place, bottom + 18}, fmt::format("{:g}", x), {.size_px = 11, .anchor = Anchor::kMiddle});
  }
  for (const double y : ticks_in(y_, wanted_ticks(box_.height))) {
    const double place = at(x_.from, y).y;
    svg.line({box_.x - kTick_px, place}, {box_.x, place}, kInk);
    svg.text({box_.x - 8, place + 4}, fmt::format("{:g}", y), {.size_px = 11, .anchor = Anchor::kEnd});
  }
  const double middle = box_.x + box_.width / 2;
  svg.text({middle, bottom + 36}, labels.x, {.anchor = Anchor::kMiddle});
  svg.text({box_.x - 46, box_.y + box_.height / 2}, labels.y, {.anchor = Anchor::kMiddle, .is_upright = true});
  svg.text({middle, box_.y - 10}, labels.title, {.size_px = 13, .anchor = Anchor::kMiddle, .is_bold = true});
}

}  // namespace lfd::plots
