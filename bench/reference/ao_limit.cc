// Sphere samples by casting.
#include "bench/reference/ao_limit.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/reference/parallel_rows.h"

namespace lfd::reference {
namespace {

constexpr int kSamplesPerBatch = 1024;

bool is_hidden(const Intersector& intersector, const ModuleView& view, Point3<Physical> sample) {
  if (!image_from_physical(view.display, view.module, sample)) return false;
  const auto shown = on_screen(view.display.optics, view.module.emitter, sample);
  const auto line = line_of_screen_point(view.display.optics, view.module.emitter, shown->at);
  const auto way = line ? visible_way(view, *line) : std::nullopt;
  if (!way || shown->depth >= way->nearest_depth) return false;
  return intersector.is_blocked(way->nearest, shown->depth > way->farthest_depth ? sample : way->farthest);
}

// Uniform in the shell between `shell` and 1.
std::vector<Vector3<World>> unit_offsets(double shell, const AoSampling& sampling) {
  std::mt19937_64 random(sampling.seed);
  std::uniform_real_distribution<double> side(-1, 1), volume(shell * shell * shell, 1);
  std::vector<Vector3<World>> offsets(static_cast<std::size_t>(sampling.samples));
  for (Vector3<World>& offset : offsets) {
    const double z = side(random), phi = M_PI * side(random), r = std::sqrt(1 - z * z),
                 radius = std::cbrt(volume(random));
    offset = {radius * r * std::cos(phi), radius * r * std::sin(phi), radius * z};
  }
  return offsets;
}

}  // namespace

double post_curve(double ao, const AoSettings& settings) {
  return 1 - std::pow(std::clamp(settings.curve.b * ((1 - ao) + settings.curve.a), 0.0, 1.0), settings.curve.c);
}

AoLimit ao_limit(const Intersector& intersector, const ModuleView& view, Point3<World> p, const AoSettings& settings,
                 const AoSampling& sampling) {
  const std::vector<Vector3<World>> offsets = unit_offsets(settings.parameter("shell"), sampling);
  const int batches = (sampling.samples + kSamplesPerBatch - 1) / kSamplesPerBatch;
  AoLimit limit;
  double radius_m = sampling.radius_m;
  for (int i = 0; i < settings.radii; ++i, radius_m /= 2) {
    std::vector<int> hidden(batches);
    for_each_row(batches, [&](int batch) {
      const int end = std::min(sampling.samples, (batch + 1) * kSamplesPerBatch);
      for (int s = batch * kSamplesPerBatch; s < end; ++s) {
        const Point3<World> sample = p + radius_m * offsets[s];
        hidden[batch] += is_hidden(intersector, view, intersector.scene().physical_from_world * sample);
      }
    });
    int sum = 0;
    for (const int count : hidden) sum += count;
    limit.hidden_share.push_back(static_cast<double>(sum) / sampling.samples);
  }
  limit.ao = *std::ranges::max_element(limit.hidden_share);
  limit.curved = post_curve(limit.ao, settings);
  return limit;
}

}  // namespace lfd::reference
