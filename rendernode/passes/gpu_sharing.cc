// Neighbours, dealt samples, and where noise begins.
#include "rendernode/passes/gpu_sharing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace lfd {
namespace {

// As in shaders/lib/surface_noise.glsl.
const glm::dmat3 kAxesOfNoise{0.573137855449, 0.740348840461, -0.351278512124, -0.609006642137, 0.671644504192,
                              0.421905877918, 0.548291809609, -0.027879282948, 0.835822252096};
constexpr int kLongestRun_log2 = 8;  // 16 pixels, each up to 16 times as large as one on the screen

bool has_set(const AoSettings& ao) { return ao.samples > 0 && ao.method->sample_set != nullptr; }

int parts_of_samples(const AoSettings& ao, int parts) {
  return std::max(1, std::min(parts, AO_MOST_SAMPLES / ao.samples));
}

}  // namespace

std::vector<glm::vec4> dealt_samples(const AoSettings& ao, int parts) {
  if (!has_set(ao)) return ao.sample_set();
  const auto count = static_cast<std::size_t>(ao.samples);
  const auto sets = static_cast<std::size_t>(parts_of_samples(ao, parts));
  AoSettings all = ao;
  all.samples *= static_cast<int>(sets);
  const std::vector<glm::vec4> samples = all.sample_set();
  const std::size_t together = count % 2 == 0 ? 2 : 1;
  std::vector<glm::vec4> dealt(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t group = i / together, part = group % sets, place = group / sets * together + i % together;
    dealt[part * count + place] = samples[i];
  }
  return dealt;
}

std::vector<shared::SharingParams> sharing_params(const Sharing& sharing, const AoSettings& ao) {
  std::vector<shared::SharingParams> all(MODULES_PER_NODE);
  for (std::size_t layer = 0; layer < sharing.window.size(); ++layer) {
    const Sharing::Window& window = sharing.window[layer];
    const int part = sharing.part[layer];
    const int first = has_set(ao) ? part % parts_of_samples(ao, sharing.parts) * ao.samples : 0;
    all[layer].window = {window.first, window.last, first, 0};
    glm::dvec3 turn(0.618034 * ao.seed, 0.754878 * ao.seed, 0.569840 * ao.seed);
    // Parts that have the same samples differ by their turns (Roberts 2018, the R sequence in three dimensions).
    const int round = has_set(ao) ? part / parts_of_samples(ao, sharing.parts) : 0;
    turn += static_cast<double>(round) * glm::dvec3(0.819173, 0.671044, 0.549700);
    if (!has_set(ao)) turn += glm::dvec3(part, 2 * part, 4 * part) / static_cast<double>(sharing.parts);  // odd
    all[layer].turn = glm::vec4(turn - glm::floor(turn), 0);
  }
  for (std::size_t rank = 0; rank < sharing.layer_of_rank.size(); ++rank)
    all[rank].rank.x = static_cast<float>(sharing.layer_of_rank[rank]);
  return all;
}

glm::vec4 noise_origin(const RegionOfInterest& roi, const DisplayCalibration& display) {
  const glm::dmat3 to_world = world_from_physical(roi).linear;
  const double width_m = display.screen.width_m / display.image.width * glm::length(to_world[0]);
  const double height_m = display.screen.height_m / display.image.height * glm::length(to_world[1]);
  const int exponent = std::ilogb(std::sqrt(width_m * height_m)) + kLongestRun_log2;
  const double run_m = std::ldexp(1.0, exponent);
  const glm::dvec3 centre = kAxesOfNoise * to_glm(roi.world_centre);
  return {centre - run_m * glm::floor(centre / run_m), exponent};
}

}  // namespace lfd
