// volumetric: Loos & Sloan, "Volumetric obscurance", I3D 2010; paired samples of Ownby et al., SIGGRAPH 2010 course.
#include "proto/occlusion/sample_sets.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"least", 0.35, 0, 1, "open share of a sample's chord from which on it is believed"},
    {"most", 1, 0, 2, "open share of a sample's chord up to which it is believed"},
};

std::vector<glm::vec4> sample_set(const SampleChoice& choice, std::span<const double>) {
  return disk_set(choice, true);
}

}  // namespace

extern const Method volumetric;
const Method volumetric{.name = "volumetric",
                        .source = "Loos & Sloan, I3D 2010; pairs: Ownby et al., SIGGRAPH 2010 course",
                        .parameters = kParameters,
                        .curve = {0.5, 1.01, 8},
                        .samples = 16,
                        .pairs = true,
                        .sample_set = sample_set};

}  // namespace lfd::occlusion
