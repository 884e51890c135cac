// One cell of a measured grid as a bicubic Bezier patch: evaluation, bounds, and inversion with a proof of absence.
#pragma once

#include <array>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <optional>

namespace lfd {

// Control points in the order of Bezier: point[4 * row + column]; (a, b) in [0, 1]^2, a along columns, b along rows.
// The patch passes through its four corners, and all of it lies in the hull of its control points.
struct BicubicPatch {
  std::array<glm::dvec2, 16> point;

  glm::dvec2 at(glm::dvec2 ab) const;
  // Columns: derivatives by a and by b.
  glm::dmat2 derivative(glm::dvec2 ab) const;
};

// The patch between nodes (1, 1) and (2, 2) of 4 x 4 neighbouring nodes (rows of columns), by Catmull-Rom: continuous
// from cell to cell with its first derivative.
BicubicPatch patch_between(const std::array<glm::dvec2, 16>& node);

struct Box2 {
  glm::dvec2 low, high;
  bool contains(glm::dvec2 p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
};

// Of the control points, widened by rounding: no point of the patch lies outside.
Box2 bounds_of(const BicubicPatch& patch);

// (a, b) where the patch is at `target` and its Jacobian has the sign of `orientation`; of several, any one. Found by
// Newton's method; where that strays, by halving the patch: a part whose bounds exclude the target is proven empty, so
// absence is an answer and not a failure. Only a patch folded onto itself nearly everywhere may be given up, as absent,
// after 20 000 parts: a bound on the time, not on what a sound cell needs (less than a hundred). Accurate to rounding
// (about 1e-15 times the condition of the patch).
std::optional<glm::dvec2> invert(const BicubicPatch& patch, glm::dvec2 target, double orientation);

}  // namespace lfd
