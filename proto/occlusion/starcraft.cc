// starcraft: Filion & McNaughton, "StarCraft II: Effects and techniques", SIGGRAPH 2008 course.
#include "proto/occlusion/sample_sets.h"

namespace lfd::occlusion {
namespace {

std::vector<glm::vec4> sample_set(const SampleChoice& choice, std::span<const double>) {
  return shell_set(choice, 0, false);
}

}  // namespace

extern const Method starcraft;
const Method starcraft{.name = "starcraft",
                       .source = "Filion & McNaughton, SIGGRAPH 2008 course, section 5.5",
                       .parameters = {},
                       .curve = {0, 1.12, 2.5},
                       .samples = 16,
                       .normal = true,
                       .directions = true,
                       .points = true,
                       .sample_set = sample_set};

}  // namespace lfd::occlusion
