// Fields of numbers as colours, with a legend that says which number is which.
#pragma once

#include <string>
#include <vector>

#include "cli/plots/axes.h"

namespace lfd::plots {

// Values to colours, dark blue over green to yellow; even in the value, or in its logarithm.
struct ColourScale {
  double low = 0, high = 1;
  bool is_logarithmic = false;
  bool is_whole = false;  // its values are whole numbers

  std::string colour_of(double value) const;
  double share_of(double value) const;  // 0 at low, 1 at high; limited
};

// From the smallest finite value to the largest, or to the 98 % quantile where few are more than twice as far away;
// logarithmic from a factor of 20; never empty.
ColourScale scale_for(std::vector<double> values);

// columns x rows places over the whole of the axes, the first at their lower left. What is not finite is left out.
struct Field {
  int columns = 0, rows = 0;
  std::vector<double> value;
};

void draw_field(Svg& svg, const Axes& axes, const Field& field, const ColourScale& scale);

// A bar of the scale's colours with numbers; the label stands above it.
void draw_scale(Svg& svg, const Box& box, const ColourScale& scale, const std::string& label);

// A small square of a colour and what it means, with its left upper corner at `at`.
void draw_key(Svg& svg, Place at, const std::string& colour, const std::string& meaning);

// The quantiles of the finite values, in words: "min 1, median 2, max 3"; "no values".
std::string spread_text(std::vector<double> values);

}  // namespace lfd::plots
