// What a method of ambient occlusion sees around a spot: the surfaces that the module's own lines meet there.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <random>
#include <string_view>

#include "bench/reference/method_limit.h"

namespace lfd::reference {

// Axes with the unit vector n as the third; the first is across n and one of `axes`.
glm::dmat3 frame_about(glm::dvec3 n, const glm::dmat3& axes = glm::dmat3(1));

// Points are in the world, in units of the radius and counted from the spot. All that it is made of must outlive it.
class Neighbourhood {
 public:
  using Vector = glm::dvec3;

  // A pixel shows the spot.
  Neighbourhood(const Intersector& intersector, const ModuleView& view, const Spot& spot, const AoSettings& settings,
                double radius_m, const LimitEffort& effort);

  Vector normal() const { return to_glm(spot_.normal); }
  Vector to_viewers() const { return view_vector_; }                    // unit, along the pixel's own line
  Vector in_disk(double x, double y) const { return x * x_ + y * y_; }  // of the disk across that line
  double parameter(std::string_view name) const { return settings_.parameter(name); }
  const LimitEffort& effort() const { return effort_; }

  // In [0, 1).
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  // In the unit ball without a smaller one within, evenly.
  Vector in_ball(double inner = 0);

  // The surface shown where a point's image is; absent where it has none or nothing is shown.
  std::optional<Hit> shown_at(Vector q) const;
  std::optional<Vector> surface_at(Vector q) const;

  // How far in front of a point the surface is that hides it.
  std::optional<double> hidden_by(Vector q) const;

 private:
  Point3<World> world(Vector q) const;
  Vector local(Point3<World> p) const { return to_glm(p - spot_.p) / radius_m_; }
  std::optional<PixelLine> line_through(Point3<World> p) const;

  const Intersector& intersector_;
  const ModuleView& view_;
  const Spot spot_;
  const AoSettings& settings_;
  const double radius_m_;
  const LimitEffort effort_;
  std::mt19937_64 random_;
  Vector view_vector_, x_, y_;
};

}  // namespace lfd::reference
