// The four spaces as types: a point of one cannot be used as a point of another.
//
//   World     the scene's own: glTF, right-handed, +y up, metres
//
//   Physical  metres; x right as a viewer sees it, y up, z from the screen toward the viewer; origin at the screen's
//             centre
//
//   Screen    metres on the screen surface: (s, y)
//
//   Image     pixels of one module: u right, v down; the first pixel's centre is (0.5, 0.5); z is physical z
//
// A transform is named by both ends, target first: physical_from_world. See Affine in affine.h.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace lfd {

struct World {};
struct Physical {};
struct Screen {};
struct Image {};

// A difference of two points.
template <class Space>
struct Vector3 {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vector3&) const = default;
};

template <class Space>
struct Point3 {
  double x = 0, y = 0, z = 0;
  bool operator==(const Point3&) const = default;
};

template <class Space>
struct Point2 {
  double x = 0, y = 0;
  bool operator==(const Point2&) const = default;
};

// A point on the screen surface: arc length (planar: x) and height, in metres.
using ScreenPoint = Point2<Screen>;
// A position in a module's image, in pixels: x is u, y is v.
using PixelPoint = Point2<Image>;

// Where a physical point lands in a module: u, v in pixels and physical z in metres.
struct ImagePoint {
  double u = 0, v = 0, z = 0;
  bool operator==(const ImagePoint&) const = default;
};

template <class S>
constexpr Point3<S> operator+(Point3<S> p, Vector3<S> d) {
  return {p.x + d.x, p.y + d.y, p.z + d.z};
}
template <class S>
constexpr Vector3<S> operator-(Point3<S> a, Point3<S> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class S>
constexpr Vector3<S> operator+(Vector3<S> a, Vector3<S> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class S>
constexpr Vector3<S> operator*(double k, Vector3<S> d) {
  return {k * d.x, k * d.y, k * d.z};
}
template <class S>
constexpr double dot(Vector3<S> a, Vector3<S> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
constexpr Vector3<S> cross(Vector3<S> a, Vector3<S> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class S>
double length(Vector3<S> d) {
  return std::sqrt(dot(d, d));
}
template <class S>
constexpr Point3<S> midpoint(Point3<S> a, Point3<S> b) {
  return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.z + b.z)};
}
template <class S>
bool is_finite(Point3<S> p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}
template <class S>
bool is_finite(Point2<S> p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

template <class S>
glm::dvec3 to_glm(Point3<S> p) {
  return {p.x, p.y, p.z};
}
template <class S>
glm::dvec3 to_glm(Vector3<S> d) {
  return {d.x, d.y, d.z};
}
template <class S>
Point3<S> point_of(glm::dvec3 v) {
  return {v.x, v.y, v.z};
}
template <class S>
Vector3<S> vector_of(glm::dvec3 v) {
  return {v.x, v.y, v.z};
}

}  // namespace lfd
