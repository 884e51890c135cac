// hbao: Bavoil, Sainz & Dimitrov, "Image-space horizon-based ambient occlusion", SIGGRAPH 2008 talk.
#include "proto/occlusion/method.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"directions", 8, 1, 128, "in the plane across the pixel's own line", true},
    {"steps", 6, 1, 80, "along each direction", true},
    {"bias", 0.3, 0, 1.5, "rad, added to the tangent's angle"},
};

}  // namespace

extern const Method hbao;
const Method hbao{.name = "hbao",
                  .source = "Bavoil et al., SIGGRAPH 2008 talk",
                  .parameters = kParameters,
                  .curve = {0, 1.03, 4},
                  .normal = true,
                  .directions = true};

}  // namespace lfd::occlusion
