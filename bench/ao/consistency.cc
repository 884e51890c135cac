// Through the calibrated map from one picture into the other.
#include "bench/ao/consistency.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "base/check.h"

namespace lfd::bench {
namespace {

constexpr double kAlike = 0.9;  // cosine between normals

struct Surface {
  glm::dvec3 position, normal;
};

std::optional<Surface> surface_of(const ShownSurfaces& shown, int column, int row) {
  const PictureF& p = shown.position;
  if (column < 0 || row < 0 || column >= p.width || row >= p.height) return std::nullopt;
  const std::size_t i = 4 * (static_cast<std::size_t>(row) * p.width + column);
  if (p.rgba[i + 3] == 0) return std::nullopt;
  const auto at = [&](const PictureF& picture) {
    return glm::dvec3(picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]);
  };
  return Surface{at(p), at(shown.normal)};
}

// The step of a pixel across the surface: how far the nearest neighbour on its tangent plane lies; absent where none
// does.
std::optional<double> step_of(const ShownSurfaces& shown, const Surface& surface, int column, int row) {
  std::optional<double> step;
  for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const auto beside = surface_of(shown, column + x, row + y);
    if (!beside || glm::dot(beside->normal, surface.normal) < kAlike) continue;
    const double apart = glm::distance(beside->position, surface.position);
    if (!step || apart < *step) step = apart;
  }
  return step;
}

bool is_same(const Surface& a, const Surface& b, double step) {
  const glm::dvec3 apart = b.position - a.position;
  return glm::dot(a.normal, b.normal) > kAlike && glm::length(apart) < 2 * step &&
         std::abs(glm::dot(apart, a.normal)) < step;
}

// The four pixels around an image point.
std::optional<SharedPoint> match(const ShownSurfaces& other, const Surface& surface, double step, PixelPoint q) {
  const int column = static_cast<int>(std::floor(q.x - 0.5)), row = static_cast<int>(std::floor(q.y - 0.5));
  const double right = q.x - 0.5 - column, below = q.y - 0.5 - row;
  SharedPoint point;
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int x = k & 1, y = k >> 1;
    const auto there = surface_of(other, column + x, row + y);
    if (!there || !is_same(surface, *there, step)) continue;
    const auto i = static_cast<std::size_t>(k);
    point.other[i] = static_cast<std::uint32_t>((row + y) * other.position.width + column + x);
    point.weight[i] = static_cast<float>((x == 1 ? right : 1 - right) * (y == 1 ? below : 1 - below));
    sum += point.weight[i];
  }
  if (sum < 0.5) return std::nullopt;
  for (float& weight : point.weight) weight /= static_cast<float>(sum);
  return point;
}

}  // namespace

std::vector<SharedPoint> shared_points(const DisplayCalibration& display, const ShownSurfaces& one,
                                       const ShownSurfaces& other,
                                       const Affine<Physical, World>& physical_from_origin) {
  std::vector<SharedPoint> points;
  for (int row = 0; row < one.position.height; ++row) {
    for (int column = 0; column < one.position.width; ++column) {
      const auto surface = surface_of(one, column, row);
      if (!surface) continue;
      const auto step = step_of(one, *surface, column, row);
      if (!step) continue;
      const glm::dvec3& p = surface->position;
      const auto q = image_from_physical(display, *other.module, physical_from_origin * Point3<World>{p.x, p.y, p.z});
      if (!q) continue;
      auto point = match(other, *surface, *step, {q->u, q->v});
      if (!point) continue;
      point->pixel = static_cast<std::uint32_t>(row * one.position.width + column);
      points.push_back(*point);
    }
  }
  return points;
}

double inconsistent_share(const std::vector<SharedPoint>& points, const Openness& one, const Openness& other) {
  if (points.empty()) return 0;
  std::size_t differ = 0, compared = 0;
  for (const SharedPoint& point : points) {
    double there = 0;
    bool is_there = one.value[point.pixel] >= 0;
    for (std::size_t k = 0; k < point.other.size(); ++k) {
      if (!(point.weight[k] > 0)) continue;
      is_there = is_there && other.value[point.other[k]] >= 0;
      there += point.weight[k] * other.value[point.other[k]];
    }
    if (!is_there) continue;
    ++compared;
    if (std::abs(there - one.value[point.pixel]) > kInconsistent) ++differ;
  }
  return compared == 0 ? 0 : static_cast<double>(differ) / static_cast<double>(compared);
}

}  // namespace lfd::bench
