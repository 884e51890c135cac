// gtao: Jimenez et al., "Practical real-time strategies for accurate indirect occlusion", 2016; its sector mask:
// Therrien et al., "Screen space indirect lighting with visibility bitmask", 2023.
#include "proto/occlusion/method.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"slices", 3, 1, 64, "planes through the pixel's own line", true},
    {"steps", 6, 1, 64, "to each side of a slice", true},
    {"falloff", 0.6, 0.01, 1, "share of the radius over which surfaces lose their weight"},
    {"bitmask", 0, 0, 1, "1: sectors of surfaces with a thickness, not horizons", true},
    {"thickness", 0.25, 0, 1000, "of surfaces, in radii; with bitmask"},
};

}  // namespace

extern const Method gtao;
const Method gtao{.name = "gtao",
                  .source = "Jimenez et al., 2016, section 4; bitmask: Therrien et al., 2023",
                  .parameters = kParameters,
                  .curve = {0, 1, 1},
                  .normal = true,
                  .directions = true};

}  // namespace lfd::occlusion
