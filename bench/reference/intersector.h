// Finds the first surface along a straight way through physical space, in double precision (the one door of Embree).
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "bench/reference/world_scene.h"

namespace lfd::reference {

// Where a line meets a surface.
struct Hit {
  Point3<Physical> physical;
  Point3<World> world;
  Vector3<World>
      geometric_normal;           // unit; of the triangle's front (counter-clockwise) side, also where its back is seen
  Vector3<World> shading_normal;  // unit; interpolated from the vertices, of the front side too
  std::uint32_t triangle = 0;     // index into WorldScene::triangle
  glm::dvec3 barycentric{0};      // of its three corners; sums to 1
};

// Embree is given boxes only, widened beyond its float32 rounding; every triangle in them is intersected here in
// double. So float32 never decides what is hit. Edges shared by two triangles (the same vertex positions) have no gap
// between them. Single-sided triangles are not hit from behind; texels of less alpha than the material's cutoff are not
// hit at all. Of hits at exactly the same place the triangle of the least number wins.
//
// `scene` must outlive the intersector. All functions may be called from many threads at once.
class Intersector {
 public:
  explicit Intersector(const WorldScene& scene);
  ~Intersector();
  Intersector(const Intersector&) = delete;
  Intersector& operator=(const Intersector&) = delete;

  const WorldScene& scene() const { return scene_; }

  // The first surface on the way from `from` to `to`; only what lies between them (ends included) counts.
  std::optional<Hit> first_hit(Point3<Physical> from, Point3<Physical> to) const;

  // Whether there is one.
  bool is_blocked(Point3<Physical> from, Point3<Physical> to) const;

 private:
  struct Boxes;

  const WorldScene& scene_;
  std::unique_ptr<const Boxes> boxes_;
};

}  // namespace lfd::reference
