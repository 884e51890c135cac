// unreal: Mittring, "The technology behind the Unreal Engine 4 Elemental demo", SIGGRAPH 2012 course.
#include "proto/occlusion/sample_sets.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"bias", 0.08, 0, 1, "taken off the cosine of each angle"},
    {"range", 1, 0.01, 1000, "samples this far before the surface, in radii, are not believed"},
};

std::vector<glm::vec4> sample_set(const SampleChoice& choice, std::span<const double>) {
  return disk_set(choice, true);
}

}  // namespace

extern const Method unreal;
const Method unreal{.name = "unreal",
                    .source = "Mittring, SIGGRAPH 2012 course",
                    .parameters = kParameters,
                    .curve = {0, 1, 3},
                    .samples = 12,
                    .pairs = true,
                    .normal = true,
                    .sample_set = sample_set};

}  // namespace lfd::occlusion
