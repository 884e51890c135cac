// crytek: Mittring, "Finding next gen: CryEngine 2", SIGGRAPH 2007 course; the whole ball, no range check.
#include "proto/occlusion/sample_sets.h"

namespace lfd::occlusion {
namespace {

std::vector<glm::vec4> sample_set(const SampleChoice& choice, std::span<const double>) {
  return shell_set(choice, 0, false);
}

}  // namespace

extern const Method crytek;
const Method crytek{.name = "crytek",
                    .source = "Mittring, SIGGRAPH 2007 course, section 8.5.4.3",
                    .parameters = {},
                    .curve = {0.57, 1, 5},
                    .samples = 16,
                    .directions = true,
                    .points = true,
                    .sample_set = sample_set};

}  // namespace lfd::occlusion
