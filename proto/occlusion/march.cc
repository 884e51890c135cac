// march: The estimator nearest to the definition: cosine-weighted rays marched through the stored positions (design
// ambient-occlusion, "Methods").
#include "proto/occlusion/sample_sets.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"steps", 4, 1, 64, "along each direction", true},
    {"thickness", 1, 0, 1000, "a step this far behind a surface, in radii, is in the open again"},
};

std::vector<glm::vec4> sample_set(const SampleChoice& choice, std::span<const double>) { return cosine_set(choice); }

}  // namespace

extern const Method march;
const Method march{.name = "march",
                   .source = "this driver: rays marched through stored positions, first hit weighed by 1 - r / R",
                   .parameters = kParameters,
                   .curve = {0, 1, 1},
                   .samples = 16,
                   .normal = true,
                   .directions = true,
                   .points = true,
                   .sample_set = sample_set};

}  // namespace lfd::occlusion
