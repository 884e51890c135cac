// Rays over the hemisphere.
#include "bench/reference/ray_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/check.h"
#include "bench/reference/neighbourhood.h"
#include "bench/reference/parallel_rows.h"

namespace lfd::reference {
namespace {

constexpr double kOffSurface = 1e-6;  // of the ROI diagonal

}  // namespace

std::vector<RayOcclusion> ray_occlusion(const Intersector& intersector, const Spot& spot,
                                        const std::vector<double>& radius_m, const RayChoice& choice) {
  LFD_CHECK(choice.rays > 0 && !radius_m.empty(), "there is something to cast");
  const WorldScene& scene = intersector.scene();
  const double farthest_m = *std::ranges::max_element(radius_m);
  const glm::dmat3 frame = frame_about(to_glm(spot.normal));
  const auto beside = [&](Point3<World> p, glm::dvec3 by) { return p + Vector3<World>{by.x, by.y, by.z}; };
  const Point3<World> from = beside(spot.p, kOffSurface * scene.roi_diagonal_m * frame[2]);
  // One direction in each cell of (height, turn): directions are uniform over the hemisphere.
  const int rows = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(choice.rays) / 2)));
  const int columns = (choice.rays + rows - 1) / rows, count = rows * columns;
  std::mt19937_64 random(choice.seed);
  std::uniform_real_distribution<double> within(0, 1);
  // Over all of the hemisphere the mean direction is 2/3 of the normal by cosine, 1/2 where each is as likely.
  std::vector<RayOcclusion> sums(radius_m.size(), {0, 0, frame[2], frame[2]});
  for (int i = 0; i < count; ++i) {
    const double height = (i / columns + within(random)) / rows, r = std::sqrt(1 - height * height);
    const double turn = 2 * std::numbers::pi * (i % columns + within(random)) / columns;
    const glm::dvec3 direction = frame * glm::dvec3(r * std::cos(turn), r * std::sin(turn), height);
    const auto hit = intersector.first_hit(scene.physical_from_world * from,
                                           scene.physical_from_world * beside(from, farthest_m * direction));
    if (!hit) continue;
    const double way_m = length(hit->world - from);
    for (std::size_t k = 0; k < radius_m.size(); ++k) {
      const double weight = std::max(0.0, 1 - way_m / radius_m[k]);
      sums[k].uniform += weight / count;
      sums[k].cosine += 2 * height * weight / count;
      sums[k].open_uniform -= 2 * weight / count * direction;
      sums[k].open_cosine -= 3 * height * weight / count * direction;
    }
  }
  return sums;
}

RayOcclusionImage ray_occlusion_of_module(const Intersector& intersector, const ModuleView& view, const HitImage& hits,
                                          const std::vector<double>& radius_m, const RayChoice& choice) {
  RayOcclusionImage image{hits.size, radius_m.size(), {}, {}};
  image.cosine.assign(hits.hit.size() * radius_m.size(), -1);
  image.uniform = image.cosine;
  for_each_row(hits.size.height, [&](int row) {
    for (int column = 0; column < hits.size.width; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row) * hits.size.width + column;
      if (!hits.hit[pixel]) continue;
      const auto found = ray_occlusion(intersector, spot_of(view, intersector.scene(), *hits.hit[pixel]), radius_m,
                                       {choice.rays, choice.seed + pixel});
      for (std::size_t k = 0; k < found.size(); ++k) {
        image.cosine[pixel * found.size() + k] = static_cast<float>(found[k].cosine);
        image.uniform[pixel * found.size() + k] = static_cast<float>(found[k].uniform);
      }
    }
  });
  return image;
}

}  // namespace lfd::reference
