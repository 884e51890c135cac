// One instance's triangles on their way to the GPU: cut at the limits in z, split by the edge rule, written out.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "rendernode/geometry/physical_geometry.h"

namespace lfd {

// A corner with everything that is interpolated, in double precision.
struct Corner {
  Point3<Physical> position;
  glm::dvec3 normal{0};  // world
  glm::dvec2 uv{0};
  glm::dvec4 color{1};
};

Corner between(const Corner& a, const Corner& b, double t);

// The same to the last bit whichever end comes first.
Corner middle_of(const Corner& a, const Corner& b);

class TriangleFeed {
 public:
  // slack_m: how far beside a triangle of the scene its plane still counts as its surface, >= 0 (PrimitivePlane).
  TriangleFeed(const DepthLimits& limits, const EdgeRule& rule, double slack_m, PhysicalGeometry& out)
      : limits_(limits), rule_(rule), slack_m_(slack_m), grazing_(kFootprint * rule.beside_m() / slack_m), out_(out) {}

  // Opens an item. corners: all vertices of its mesh.
  void begin_item(std::uint32_t material, std::vector<Corner> corners);

  // A triangle of the item by its vertices. Triangles share corners, pieces of the same edge their middles.
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  // Closes the item; an empty one leaves no trace.
  void end_item(std::string content);

 private:
  // Pixels are larger away from the screen: twice as large before it at half the observers' distance.
  static constexpr double kFootprint = 2;

  using Triangle = std::array<std::uint32_t, 3>;  // numbers in corners_
  void add_cut(const Triangle& triangle, const shared::PrimitivePlane& plane);
  void split(const Triangle& triangle, const shared::PrimitivePlane& plane, int depth);
  void emit(const Triangle& triangle, const shared::PrimitivePlane& plane);
  std::uint32_t middle(std::uint32_t a, std::uint32_t b);
  std::uint32_t append(const Corner& corner);
  std::uint32_t write(const Corner& corner);

  const DepthLimits& limits_;
  const EdgeRule& rule_;
  double slack_m_;
  double grazing_;  // sine of the angle below which pixels are held to the triangle
  PhysicalGeometry& out_;
  GeometryItem item_;
  std::vector<Corner> corners_;                               // the mesh's, then those made by cutting and splitting
  std::vector<std::uint32_t> written_;                        // output index of each corner, or kNotWritten
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  // by the numbers of both ends, the smaller one first
};

}  // namespace lfd
