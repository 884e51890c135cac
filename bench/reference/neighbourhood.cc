// Lines through the neighbourhood.
#include "bench/reference/neighbourhood.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/check.h"

namespace lfd::reference {

glm::dmat3 frame_about(glm::dvec3 n, const glm::dmat3& axes) {
  const glm::dvec3 aside = std::abs(glm::dot(n, axes[0])) < 0.7 ? axes[0] : axes[1];
  const glm::dvec3 x = glm::normalize(glm::cross(aside, n));
  return {x, glm::cross(n, x), n};
}

Neighbourhood::Neighbourhood(const Intersector& intersector, const ModuleView& view, const Spot& spot,
                             const AoSettings& settings, double radius_m, const LimitEffort& effort)
    : intersector_(intersector),
      view_(view),
      spot_(spot),
      settings_(settings),
      radius_m_(radius_m),
      effort_(effort),
      random_(effort.seed) {
  const auto line = line_through(spot.p);
  LFD_CHECK(line.has_value(), "a pixel shows the spot");
  const auto& world_from_physical = intersector.scene().world_from_physical;
  view_vector_ =
      glm::normalize(to_glm(world_from_physical * line->on_observer_line - world_from_physical * line->on_screen));
  // Along the display's axes, as the shaders: a method with few directions depends on them.
  const glm::dmat3& axes = world_from_physical.linear;
  const glm::dmat3 frame =
      frame_about(view_vector_, {glm::normalize(axes[0]), glm::normalize(axes[1]), glm::normalize(axes[2])});
  x_ = frame[0];
  y_ = frame[1];
}

Neighbourhood::Vector Neighbourhood::in_ball(double inner) {
  const double z = 2 * uniform() - 1, phi = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
  return std::cbrt(inner * inner * inner + (1 - inner * inner * inner) * uniform()) *
         Vector(r * std::cos(phi), r * std::sin(phi), z);
}

std::optional<Hit> Neighbourhood::shown_at(Vector q) const {
  const auto line = line_through(world(q));
  const auto way = line ? visible_way(view_, *line) : std::nullopt;
  return way ? intersector_.first_hit(way->nearest, way->farthest) : std::nullopt;
}

std::optional<Neighbourhood::Vector> Neighbourhood::surface_at(Vector q) const {
  const auto hit = shown_at(q);
  return hit ? std::optional(local(hit->world)) : std::nullopt;
}

std::optional<double> Neighbourhood::hidden_by(Vector q) const {
  const auto hit = shown_at(q);
  if (!hit) return std::nullopt;
  const auto depth = [&](Point3<Physical> p) {
    return on_screen(view_.display.optics, view_.module.emitter, p)->depth;
  };
  if (depth(hit->physical) <= depth(intersector_.scene().physical_from_world * world(q))) return std::nullopt;
  return glm::length(local(hit->world) - q);
}

Point3<World> Neighbourhood::world(Vector q) const {
  return spot_.p + Vector3<World>{radius_m_ * q.x, radius_m_ * q.y, radius_m_ * q.z};
}

std::optional<PixelLine> Neighbourhood::line_through(Point3<World> p) const {
  const Point3<Physical> at = intersector_.scene().physical_from_world * p;
  if (!image_from_physical(view_.display, view_.module, at)) return std::nullopt;
  const auto shown = on_screen(view_.display.optics, view_.module.emitter, at);
  return line_of_screen_point(view_.display.optics, view_.module.emitter, shown->at);
}

}  // namespace lfd::reference
