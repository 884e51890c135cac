// alchemy: McGuire, Osman, Bukowski & Hennessy, "The Alchemy screen-space ambient obscurance algorithm", HPG 2011.
#include "proto/occlusion/sample_sets.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"sigma", 0.2, 0, 100, "strength, in radii"},
    {"beta", 0.01, 0, 1, "bias along the normal, in radii"},
    {"epsilon", 1e-4, 1e-9, 1, "kept from zero by, in squared radii"},
};

std::vector<glm::vec4> sample_set(const SampleChoice& choice, std::span<const double>) {
  return disk_set(choice, false);
}

}  // namespace

extern const Method alchemy;
const Method alchemy{.name = "alchemy",
                     .source = "McGuire et al., HPG 2011, equation 10",
                     .parameters = kParameters,
                     .curve = {0, 1.005, 5},
                     .samples = 16,
                     .normal = true,
                     .sample_set = sample_set};

}  // namespace lfd::occlusion
