// The frame of a plot: a range of two quantities on a box of the drawing, with ticks, labels and a title.
#pragma once

#include <string>
#include <vector>

#include "cli/plots/svg.h"

namespace lfd::plots {

// From the value at the left (or at the bottom) to that at the right (at the top); it may fall.
struct Range {
  double from = 0, to = 1;
};

// Multiples of 1, 2 or 5 times a power of ten within the range, about `wanted` of them, ascending.
std::vector<double> ticks_in(Range range, int wanted);

// The largest box of the ranges' own proportions, at the upper edge of `box` and in its middle: one metre is as long in
// both directions.
Box with_equal_scales(const Box& box, Range x, Range y);

// How many times their length arrows are to be drawn: 1, 2 or 5 times a power of ten, at least 1, so that the longest
// spans about one and a half places.
double arrow_scale(double longest_px, double place_px);

struct Labels {
  std::string title, x, y;  // axes with their units
};

class Axes {
 public:
  Axes(const Box& box, Range x, Range y) : box_(box), x_(x), y_(y) {}

  const Box& box() const { return box_; }
  double bottom_px() const { return box_.y + box_.height; }
  Place at(double x, double y) const;

  // Frame, ticks and labels, all outside the box but for the frame.
  void draw(Svg& svg, const Labels& labels) const;
  // Light lines at the ticks, to be drawn first.
  void draw_grid(Svg& svg) const;

 private:
  Box box_;
  Range x_, y_;
};

}  // namespace lfd::plots
