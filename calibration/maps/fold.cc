// The Jacobian's determinant in Bezier form, and its halving until the sign is known.
#include "calibration/maps/fold.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lfd {
namespace {

constexpr std::size_t kSide = 6;  // coefficients of degree 5
// Of either side. A coefficient is off its polynomial by at most 4.8 M / 4^halvings, with M the largest at the
// beginning: 0.6 times the second differences along each axis, which halving quarters.
constexpr int kMostHalvings = 7;

// Of a polynomial of degree 5 along a and along b: at[kSide * row + column], a along columns.
using Determinant = std::array<double, kSide * kSide>;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }
double longest(glm::dvec2 a) { return std::max(std::abs(a.x), std::abs(a.y)); }

// The product of Bezier polynomials of degrees 2 and 3: coefficient i of one and k of the other count in coefficient
// i + k with the weight C(2, i) C(3, k) / C(5, i + k).
constexpr double kWeight[3][4] = {
    {1, 3 / 5., 3 / 10., 1 / 10.}, {2 / 5., 6 / 10., 6 / 10., 2 / 5.}, {1 / 10., 3 / 10., 3 / 5., 1}};

// The derivatives by a and by b in Bezier form, to a factor of 3, which does not matter here.
struct Slopes {
  std::array<std::array<glm::dvec2, 3>, 4> by_a;  // [row][column]
  std::array<std::array<glm::dvec2, 4>, 3> by_b;
};

Slopes slopes_of(const BicubicPatch& patch) {
  Slopes slopes;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      slopes.by_a[i][k] = patch.point[4 * i + k + 1] - patch.point[4 * i + k];
      slopes.by_b[k][i] = patch.point[4 * (k + 1) + i] - patch.point[4 * k + i];
    }
  }
  return slopes;
}

Determinant determinant_of(const Slopes& slopes, double orientation) {
  Determinant product{};
  for (std::size_t row_a = 0; row_a < 4; ++row_a) {
    for (std::size_t row_b = 0; row_b < 3; ++row_b) {
      for (std::size_t column_a = 0; column_a < 3; ++column_a) {
        for (std::size_t column_b = 0; column_b < 4; ++column_b) {
          const double weight = kWeight[row_b][row_a] * kWeight[column_a][column_b];
          product[kSide * (row_a + row_b) + column_a + column_b] +=
              orientation * weight * cross(slopes.by_a[row_a][column_a], slopes.by_b[row_b][column_b]);
        }
      }
    }
  }
  return product;
}

// More than all that rounding can do to a coefficient.
double rounding_of(const Slopes& slopes) {
  double by_a = 0, by_b = 0;
  for (const auto& row : slopes.by_a) {
    for (const glm::dvec2 slope : row) by_a = std::max(by_a, longest(slope));
  }
  for (const auto& row : slopes.by_b) {
    for (const glm::dvec2 slope : row) by_b = std::max(by_b, longest(slope));
  }
  return 1e-13 * by_a * by_b;
}

// De Casteljau along one axis: `stride` from coefficient to coefficient, `across` from line to line.
std::pair<Determinant, Determinant> halves(const Determinant& whole, std::size_t stride, std::size_t across) {
  Determinant low = whole, high = whole;
  for (std::size_t line = 0; line < kSide; ++line) {
    const auto at = [&](std::size_t i) { return line * across + i * stride; };
    for (std::size_t step = 1; step < kSide; ++step) {
      low[at(step - 1)] = high[at(0)];
      for (std::size_t i = 0; i + step < kSide; ++i) high[at(i)] = 0.5 * (high[at(i)] + high[at(i + 1)]);
    }
    low[at(kSide - 1)] = high[at(0)];
  }
  return {low, high};
}

// More than `least` all over the part of the cell that is left after so many halvings of both sides together.
bool is_proven_above(double least, const Determinant& d, int halvings) {
  if (std::ranges::all_of(d, [least](double coefficient) { return coefficient > least; })) return true;
  // The coefficients of the corners are the determinants there.
  const double at_corners = std::min({d[0], d[kSide - 1], d[kSide * (kSide - 1)], d[kSide * kSide - 1]});
  if (at_corners <= least || halvings == 2 * kMostHalvings) return false;
  const bool along_a = halvings % 2 == 0;
  const auto [low, high] = halves(d, along_a ? 1 : kSide, along_a ? kSide : 1);
  return is_proven_above(least, low, halvings + 1) && is_proven_above(least, high, halvings + 1);
}

}  // namespace

bool keeps_orientation(const BicubicPatch& patch, double orientation) {
  const Slopes slopes = slopes_of(patch);
  return is_proven_above(rounding_of(slopes), determinant_of(slopes, orientation), 0);
}

}  // namespace lfd
