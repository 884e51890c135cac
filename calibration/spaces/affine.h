// Affine maps between spaces, named and typed by both ends: a_from_b * b_from_c is a_from_c; nothing else compiles.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "calibration/spaces/spaces.h"

namespace lfd {

template <class To, class From>
struct Affine {
  glm::dmat3 linear{1.0};
  glm::dvec3 offset{0.0};
  bool operator==(const Affine&) const = default;
};

template <class A, class B>
Point3<A> operator*(const Affine<A, B>& a_from_b, Point3<B> p) {
  return point_of<A>(a_from_b.linear * to_glm(p) + a_from_b.offset);
}

template <class A, class B>
Vector3<A> operator*(const Affine<A, B>& a_from_b, Vector3<B> d) {
  return vector_of<A>(a_from_b.linear * to_glm(d));
}

template <class A, class B, class C>
Affine<A, C> operator*(const Affine<A, B>& a_from_b, const Affine<B, C>& b_from_c) {
  return {a_from_b.linear * b_from_c.linear, a_from_b.linear * b_from_c.offset + a_from_b.offset};
}

// b_from_a; absent where the determinant is zero or not finite.
template <class A, class B>
std::optional<Affine<B, A>> inverse(const Affine<A, B>& a_from_b) {
  const double determinant = glm::determinant(a_from_b.linear);
  if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) return std::nullopt;
  const glm::dmat3 linear = glm::inverse(a_from_b.linear);
  return Affine<B, A>{linear, -(linear * a_from_b.offset)};
}

}  // namespace lfd
