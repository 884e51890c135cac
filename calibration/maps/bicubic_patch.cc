// Bezier arithmetic and the safeguarded inverse.
#include "calibration/maps/bicubic_patch.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

namespace lfd {
namespace {

constexpr int kNewtonSteps = 12;
constexpr int kMostHalvings = 40;  // of one side: 1e-12 of the cell
constexpr int kMostParts = 20000;  // looked at before a patch that is folded onto itself everywhere is given up
constexpr double kBorder = 1e-12;  // cells are closed: a point on their border belongs to both neighbours

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

std::array<double, 4> bernstein_slope(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

glm::dvec2 weighted(const BicubicPatch& patch, const std::array<double, 4>& along_a,
                    const std::array<double, 4>& along_b) {
  glm::dvec2 sum(0.0);
  for (std::size_t row = 0; row < 4; ++row) {
    glm::dvec2 line(0.0);
    for (std::size_t column = 0; column < 4; ++column) line += along_a[column] * patch.point[4 * row + column];
    sum += along_b[row] * line;
  }
  return sum;
}

// Both halves of a Bezier curve of four points that lie `stride` apart (de Casteljau).
void halve(const std::array<glm::dvec2, 16>& whole, std::size_t first, std::size_t stride,
           std::array<glm::dvec2, 16>& low, std::array<glm::dvec2, 16>& high) {
  const glm::dvec2 p0 = whole[first], p1 = whole[first + stride], p2 = whole[first + 2 * stride],
                   p3 = whole[first + 3 * stride];
  const glm::dvec2 p01 = 0.5 * (p0 + p1), p12 = 0.5 * (p1 + p2), p23 = 0.5 * (p2 + p3);
  const glm::dvec2 p012 = 0.5 * (p01 + p12), p123 = 0.5 * (p12 + p23), middle = 0.5 * (p012 + p123);
  const std::array<glm::dvec2, 4> lower{p0, p01, p012, middle}, upper{middle, p123, p23, p3};
  for (std::size_t i = 0; i < 4; ++i) {
    low[first + i * stride] = lower[i];
    high[first + i * stride] = upper[i];
  }
}

// A part of a patch: where it lies in it, and its own control points.
struct Part {
  BicubicPatch patch;
  glm::dvec2 low{0.0}, size{1.0};
  int halvings = 0;
};

std::array<Part, 2> halves(const Part& part) {
  const bool along_a = part.halvings % 2 == 0;
  std::array<Part, 2> made{part, part};
  for (std::size_t i = 0; i < 4; ++i) {
    halve(part.patch.point, along_a ? 4 * i : i, along_a ? 1 : 4, made[0].patch.point, made[1].patch.point);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    double& size = along_a ? made[i].size.x : made[i].size.y;
    double& low = along_a ? made[i].low.x : made[i].low.y;
    size *= 0.5;
    low += static_cast<double>(i) * size;
    ++made[i].halvings;
  }
  return made;
}

bool in_cell(glm::dvec2 ab) {
  return ab.x >= -kBorder && ab.x <= 1 + kBorder && ab.y >= -kBorder && ab.y <= 1 + kBorder;
}

// Newton from `ab`, held near the cell; absent where it does not settle in it with the wanted orientation.
std::optional<glm::dvec2> newton(const BicubicPatch& patch, glm::dvec2 target, double orientation, glm::dvec2 ab) {
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kNewtonSteps; ++i) {
    const glm::dvec2 off = target - patch.at(ab);
    const glm::dmat2 slope = patch.derivative(ab);
    const double det = glm::determinant(slope);
    if (!(det * orientation > 0)) return std::nullopt;
    const glm::dvec2 step = glm::inverse(slope) * off;
    const double length = std::max(std::abs(step.x), std::abs(step.y));
    ab = glm::clamp(ab + step, glm::dvec2(-0.5), glm::dvec2(1.5));
    // Settled: the step is of the size of rounding, or no longer shrinks below what rounding allows.
    if (length < 1e-15 || (length < 1e-9 && length >= 0.5 * last)) {
      if (!in_cell(ab) || !(glm::determinant(patch.derivative(ab)) * orientation > 0)) return std::nullopt;
      return glm::clamp(ab, glm::dvec2(0.0), glm::dvec2(1.0));
    }
    last = length;
  }
  return std::nullopt;
}

}  // namespace

glm::dvec2 BicubicPatch::at(glm::dvec2 ab) const { return weighted(*this, bernstein(ab.x), bernstein(ab.y)); }

glm::dmat2 BicubicPatch::derivative(glm::dvec2 ab) const {
  return {weighted(*this, bernstein_slope(ab.x), bernstein(ab.y)),
          weighted(*this, bernstein(ab.x), bernstein_slope(ab.y))};
}

BicubicPatch patch_between(const std::array<glm::dvec2, 16>& node) {
  const auto bezier = [](glm::dvec2 before, glm::dvec2 from, glm::dvec2 to, glm::dvec2 after) {
    return std::array<glm::dvec2, 4>{from, from + (to - before) / 6.0, to - (after - from) / 6.0, to};
  };
  std::array<glm::dvec2, 16> along_rows;
  for (std::size_t row = 0; row < 4; ++row) {
    const auto line = bezier(node[4 * row], node[4 * row + 1], node[4 * row + 2], node[4 * row + 3]);
    std::copy(line.begin(), line.end(), along_rows.begin() + static_cast<std::ptrdiff_t>(4 * row));
  }
  BicubicPatch patch;
  for (std::size_t column = 0; column < 4; ++column) {
    const auto line =
        bezier(along_rows[column], along_rows[4 + column], along_rows[8 + column], along_rows[12 + column]);
    for (std::size_t row = 0; row < 4; ++row) patch.point[4 * row + column] = line[row];
  }
  return patch;
}

Box2 bounds_of(const BicubicPatch& patch) {
  Box2 box{patch.point[0], patch.point[0]};
  for (const glm::dvec2 p : patch.point) {
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  const glm::dvec2 rounding = 1e-14 * (glm::abs(box.low) + glm::abs(box.high));
  box.low -= rounding;
  box.high += rounding;
  return box;
}

std::optional<glm::dvec2> invert(const BicubicPatch& patch, glm::dvec2 target, double orientation) {
  if (!bounds_of(patch).contains(target)) return std::nullopt;
  if (const auto found = newton(patch, target, orientation, glm::dvec2(0.5))) return found;
  std::vector<Part> parts{{patch}};
  for (int looked_at = 0; !parts.empty() && looked_at < kMostParts; ++looked_at) {
    const Part part = parts.back();
    parts.pop_back();
    if (!bounds_of(part.patch).contains(target)) continue;
    if (part.halvings > 0 && part.halvings % 4 == 0) {
      if (const auto found = newton(patch, target, orientation, part.low + 0.5 * part.size)) return found;
    }
    if (part.halvings >= 2 * kMostHalvings) continue;  // only a fold line itself is left, which has no orientation
    for (const Part& half : halves(part)) parts.push_back(half);
  }
  return std::nullopt;
}

}  // namespace lfd
