// sphere: Doronin et al., WSCG 2017, Algorithm 2.
#include "proto/occlusion/sample_sets.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"shell", 0.8, 0, 1, "inner radius of the shell of samples over the radius"},
    {"symmetric", 0, 0, 1, "1: samples come in pairs that mirror each other, a flat wall is exactly half hidden", true},
};

std::vector<glm::vec4> sample_set(const SampleChoice& choice, std::span<const double> parameters) {
  return shell_set(choice, parameters[0], parameters[1] != 0);
}

}  // namespace

extern const Method sphere;
const Method sphere{.name = "sphere",
                    .source = "Doronin et al., WSCG 2017, Algorithm 2",
                    .parameters = kParameters,
                    .curve = {0.5, 1, 1},
                    .samples = 8,
                    .directions = true,
                    .points = true,
                    .sample_set = sample_set};

}  // namespace lfd::occlusion
