// Colours by interpolation between nine of the perceptually even scale "viridis".
#include "cli/plots/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/log.h"

namespace lfd::plots {
namespace {

using Colour = std::array<double, 3>;
constexpr std::array<Colour, 9> kViridis{{{68, 1, 84},
                                          {71, 44, 122},
                                          {59, 81, 139},
                                          {44, 113, 142},
                                          {33, 144, 141},
                                          {39, 173, 129},
                                          {92, 200, 99},
                                          {170, 220, 50},
                                          {253, 231, 37}}};
constexpr double kLogarithmicFrom = 20;
constexpr double kFar = 2;

std::vector<double> finite(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values;
}

std::string colour_at(double share) {
  const double place = share * (kViridis.size() - 1);
  const auto left = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(left);
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    rgb[i] = static_cast<int>(std::lround((1 - part) * kViridis[left][i] + part * kViridis[left + 1][i]));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

// The numbers that stand beside a scale: round ones; of a logarithmic one, powers of ten.
std::vector<double> numbers_of(const ColourScale& scale) {
  std::vector<double> numbers;
  if (scale.is_logarithmic) {
    for (const double decade : ticks_in({std::log10(scale.low), std::log10(scale.high)}, 5)) {
      if (decade == std::round(decade)) numbers.push_back(std::pow(10, decade));
    }
    return numbers.empty() ? std::vector{scale.low, scale.high} : numbers;
  }
  numbers = ticks_in({scale.low, scale.high}, 5);
  if (scale.is_whole) std::erase_if(numbers, [](double number) { return number != std::round(number); });
  return numbers;
}

}  // namespace

double ColourScale::share_of(double value) const {
  const double share = is_logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0;
}

std::string ColourScale::colour_of(double value) const { return colour_at(share_of(value)); }

ColourScale scale_for(std::vector<double> values) {
  std::vector<double> known = finite(std::move(values));
  if (known.empty()) return {};
  std::ranges::sort(known);
  const double low = known.front(), most = known[known.size() * 98 / 100];
  const double high = known.back() - low > kFar * (most - low) && most > low ? most : known.back();
  ColourScale scale{low, high, low > 0 && high / low > kLogarithmicFrom};
  if (!(scale.high > scale.low * (1 + 1e-6))) scale.high = scale.low + std::max(1e-3 * std::abs(scale.low), 1e-300);
  return scale;
}

void draw_field(Svg& svg, const Axes& axes, const Field& field, const ColourScale& scale) {
  const Box& box = axes.box();
  const double width = box.width / field.columns, height = box.height / field.rows;
  svg.begin_crisp();
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      const double value = field.value[static_cast<std::size_t>(row * field.columns + column)];
      if (!std::isfinite(value)) continue;
      // A little larger than the place: no light line between neighbours.
      svg.rectangle({box.x + column * width, box.y + box.height - (row + 1) * height, width + 0.4, height + 0.4},
                    {.fill = scale.colour_of(value)});
    }
  }
  svg.end_group();
}

void draw_scale(Svg& svg, const Box& box, const ColourScale& scale, const std::string& label) {
  constexpr int kSteps = 64;
  svg.begin_crisp();
  for (int i = 0; i < kSteps; ++i) {
    const double height = box.height / kSteps;
    svg.rectangle({box.x, box.y + box.height - (i + 1) * height, box.width, height + 0.4},
                  {.fill = colour_at((i + 0.5) / kSteps)});
  }
  svg.end_group();
  svg.rectangle(box, {.stroke = "#444444"});
  for (const double number : numbers_of(scale)) {
    const double place = box.y + box.height * (1 - scale.share_of(number));
    svg.line({box.x + box.width, place}, {box.x + box.width + 4, place}, {.stroke = "#444444"});
    svg.text({box.x + box.width + 8, place + 4}, fmt::format("{:.4g}", number), {.size_px = 11});
  }
  svg.text({box.x, box.y - 10}, label, {.size_px = 11});
}

void draw_key(Svg& svg, Place at, const std::string& colour, const std::string& meaning) {
  svg.rectangle({at.x, at.y, 13, 13}, {.stroke = "#444444", .fill = colour});
  svg.text({at.x + 20, at.y + 11}, meaning, {.size_px = 12});
}

std::string spread_text(std::vector<double> values) {
  std::vector<double> known = finite(std::move(values));
  if (known.empty()) return "no values";
  std::ranges::sort(known);
  return fmt::format("min {:.4g}, median {:.4g}, max {:.4g}", known.front(), known[(known.size() - 1) / 2],
                     known.back());
}

}  // namespace lfd::plots
