// scalable: McGuire, Mara & Luebke, "Scalable ambient obscurance", HPG 2012.
#include "proto/occlusion/method.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"levels", 5, 1, kMostPyramidLevels, "of the pyramid, the full picture counted", true},
    {"sigma", 0.2, 0, 100, "strength, in radii"},
    {"beta", 0.01, 0, 1, "bias along the normal, in radii"},
    {"epsilon", 1e-4, 1e-9, 1, "kept from zero by, in squared radii"},
    {"turns", 7, 1, 50, "of the spiral of taps", true},
};

}  // namespace

extern const Method scalable;
const Method scalable{.name = "scalable",
                      .source = "McGuire et al., HPG 2012",
                      .parameters = kParameters,
                      .curve = {0, 1.005, 5},
                      .samples = 16,
                      .normal = true,
                      .pyramid = Pyramid::kPicked};

}  // namespace lfd::occlusion
