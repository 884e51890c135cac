// Embree walks the boxes; the triangles in them are intersected in double precision.
#include "bench/reference/intersector.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lfd::reference {
namespace {

// Boxes are widened by this share of the scene's largest coordinate: rounding a ray to float32 moves it by at most some
// 1e-7.
constexpr double kBoxMargin = 2e-6;
// Ways are cut to the scene's bounds, widened by this share of the largest coordinate: then float32 rays start near the
// scene.
constexpr double kBoundsMargin = 1e-2;

struct Crossing {
  double t = 0;  // along the way: 0 at its start, 1 at its end
  glm::dvec3 barycentric{0};
};

// The line from + t d with a triangle. The weights are triple products of the line with the edges: exactly opposite for
// the two triangles of an edge (no fused multiply-add on this target), so no line slips between neighbours.
std::optional<Crossing> cross_triangle(glm::dvec3 from, glm::dvec3 d, const std::array<glm::dvec3, 3>& p,
                                       bool double_sided) {
  const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double slope = glm::dot(normal, d);  // < 0: d meets the front
  if (slope == 0 || (slope > 0 && !double_sided)) return std::nullopt;
  const glm::dvec3 a = p[0] - from, b = p[1] - from, c = p[2] - from;
  const glm::dvec3 weight{glm::dot(d, glm::cross(b, c)), glm::dot(d, glm::cross(c, a)), glm::dot(d, glm::cross(a, b))};
  const bool inside =
      (weight.x >= 0 && weight.y >= 0 && weight.z >= 0) || (weight.x <= 0 && weight.y <= 0 && weight.z <= 0);
  const double sum = weight.x + weight.y + weight.z;
  if (!inside || sum == 0) return std::nullopt;
  return Crossing{glm::dot(normal, a) / slope, weight / sum};
}

std::array<glm::dvec3, 3> physical_corners(const WorldScene& scene, const Triangle& t) {
  return {to_glm(scene.corner(t, 0).physical), to_glm(scene.corner(t, 1).physical),
          to_glm(scene.corner(t, 2).physical)};
}

// One query. `context` comes first, so that Embree's pointer to it is one to the whole.
struct Way {
  RTCIntersectContext context;
  const WorldScene* scene;
  glm::dvec3 from, d;
  double embree_start, embree_length;  // Embree walks t = start .. start + length as its own 0 .. 1
  bool any;                            // the first triangle found is enough
  Crossing best;
  std::optional<std::uint32_t> triangle;

  // Takes the triangle if it is met before the best so far. True if it was.
  bool offer(std::uint32_t number) {
    const Triangle& candidate = scene->triangle[number];
    const Material& material = scene->material[candidate.material];
    const auto crossing = cross_triangle(from, d, physical_corners(*scene, candidate), material.double_sided);
    if (!crossing || !(crossing->t >= 0 && crossing->t <= 1)) return false;
    if (triangle && (crossing->t > best.t || (crossing->t == best.t && number > *triangle))) return false;
    if (material.alpha_cutoff && scene->base_color(candidate, crossing->barycentric).a < *material.alpha_cutoff)
      return false;
    best = *crossing;
    triangle = number;
    return true;
  }

  // The part of the way that lies within a box. False if there is none.
  bool clip_to(glm::dvec3 low, glm::dvec3 high) {
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (d[axis] == 0) {
        if (from[axis] < low[axis] || from[axis] > high[axis]) return false;
        continue;
      }
      const double at_low = (low[axis] - from[axis]) / d[axis], at_high = (high[axis] - from[axis]) / d[axis];
      enter = std::max(enter, std::min(at_low, at_high));
      leave = std::min(leave, std::max(at_low, at_high));
    }
    embree_start = enter;
    embree_length = leave - enter;
    return embree_length > 0;
  }
};

Hit hit_of(const WorldScene& scene, const Way& way) {
  const Triangle& t = scene.triangle[*way.triangle];
  const glm::dvec3 share = way.best.barycentric;
  std::array<glm::dvec3, 3> world;
  glm::dvec3 normal(0);
  for (int i = 0; i < 3; ++i) {
    world[i] = to_glm(scene.corner(t, i).world);
    normal += share[i] * to_glm(scene.corner(t, i).normal);
  }
  const glm::dvec3 geometric = glm::normalize(glm::cross(world[1] - world[0], world[2] - world[0]));
  Hit hit;
  hit.physical = point_of<Physical>(way.from + way.best.t * way.d);
  hit.world = point_of<World>(world[0] + share[1] * (world[1] - world[0]) + share[2] * (world[2] - world[0]));
  hit.geometric_normal = vector_of<World>(geometric);
  hit.shading_normal = vector_of<World>(glm::length(normal) > 0 ? glm::normalize(normal) : geometric);
  hit.triangle = *way.triangle;
  hit.barycentric = share;
  return hit;
}

}  // namespace

// Embree's tree of the triangles' boxes.
struct Intersector::Boxes {
  explicit Boxes(const WorldScene& scene);
  Boxes(const Boxes&) = delete;
  Boxes& operator=(const Boxes&) = delete;
  ~Boxes() {
    rtcReleaseScene(tree);
    rtcReleaseDevice(device);
  }

  bool trace(Way& way) const;
  static void bounds_of_triangle(const RTCBoundsFunctionArguments* args);
  static void cross_candidate(const RTCIntersectFunctionNArguments* args);

  const WorldScene& world;
  glm::dvec3 low{INFINITY}, high{-INFINITY};  // of all triangles
  double largest_coordinate_m = 0;
  RTCDevice device = nullptr;
  RTCScene tree = nullptr;
};

Intersector::Boxes::Boxes(const WorldScene& scene) : world(scene) {
  for (const Vertex& v : scene.vertex) {
    low = glm::min(low, to_glm(v.physical));
    high = glm::max(high, to_glm(v.physical));
  }
  for (int axis = 0; axis < 3 && !scene.vertex.empty(); ++axis) {
    largest_coordinate_m = std::max({largest_coordinate_m, std::abs(low[axis]), std::abs(high[axis])});
  }
  device = rtcNewDevice(nullptr);
  LFD_CHECK(device != nullptr, "Embree runs on this processor");
  tree = rtcNewScene(device);
  rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tree, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.triangle.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, bounds_of_triangle, nullptr);
  rtcSetGeometryIntersectFunction(geometry, cross_candidate);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tree);
  LFD_CHECK(rtcGetDeviceError(device) == RTC_ERROR_NONE, "Embree has built its tree");
}

void Intersector::Boxes::bounds_of_triangle(const RTCBoundsFunctionArguments* args) {
  const auto& boxes = *static_cast<const Boxes*>(args->geometryUserPtr);
  const auto p = physical_corners(boxes.world, boxes.world.triangle[args->primID]);
  const glm::dvec3 margin(kBoxMargin * boxes.largest_coordinate_m);
  const glm::vec3 least(glm::min(glm::min(p[0], p[1]), p[2]) - margin);
  const glm::vec3 most(glm::max(glm::max(p[0], p[1]), p[2]) + margin);
  *args->bounds_o = {least.x, least.y, least.z, 0, most.x, most.y, most.z, 0};
}

void Intersector::Boxes::cross_candidate(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  Way& way = *reinterpret_cast<Way*>(args->context);
  if (!way.offer(args->primID)) return;
  // Rays are cast one at a time, so the packet is one RTCRayHit.
  RTCRayHit& ray = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const double t = std::max(0.0, (way.best.t - way.embree_start) / way.embree_length);
  // Rounded up, so that another triangle at the same place is still looked at.
  ray.ray.tfar = way.any ? 0.0F : static_cast<float>(t * (1 + 1e-6) + 1e-6);
  ray.hit.geomID = args->geomID;
  ray.hit.primID = args->primID;
}

bool Intersector::Boxes::trace(Way& way) const {
  if (world.triangle.empty()) return false;
  const glm::dvec3 margin(kBoundsMargin * largest_coordinate_m);
  if (!way.clip_to(low - margin, high + margin)) return false;
  way.scene = &world;
  rtcInitIntersectContext(&way.context);
  const glm::vec3 start(way.from + way.embree_start * way.d), direction(way.embree_length * way.d);
  RTCRayHit ray{};
  ray.ray.org_x = start.x;
  ray.ray.org_y = start.y;
  ray.ray.org_z = start.z;
  ray.ray.dir_x = direction.x;
  ray.ray.dir_y = direction.y;
  ray.ray.dir_z = direction.z;
  ray.ray.tfar = 1 + 1e-6F;
  ray.ray.mask = 0xFFFFFFFFU;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tree, &way.context, &ray);
  return way.triangle.has_value();
}

Intersector::Intersector(const WorldScene& scene) : scene_(scene), boxes_(std::make_unique<Boxes>(scene)) {}

Intersector::~Intersector() = default;

std::optional<Hit> Intersector::first_hit(Point3<Physical> from, Point3<Physical> to) const {
  Way way{};
  way.from = to_glm(from);
  way.d = to_glm(to - from);
  if (!boxes_->trace(way)) return std::nullopt;
  return hit_of(scene_, way);
}

bool Intersector::is_blocked(Point3<Physical> from, Point3<Physical> to) const {
  Way way{};
  way.from = to_glm(from);
  way.d = to_glm(to - from);
  way.any = true;
  return boxes_->trace(way);
}

}  // namespace lfd::reference
