// pyramid_hbao: "Pyramid HBAO", 2021: along each direction one cone of ever coarser levels.
#include "proto/occlusion/method.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"levels", 5, 1, kMostPyramidLevels, "of the pyramid, the full picture counted", true},
    {"directions", 8, 1, 64, "across the pixel's own line", true},
    {"steps", 4, 1, 64, "along each direction on each level", true},
};

}  // namespace

extern const Method pyramid_hbao;
const Method pyramid_hbao{.name = "pyramid_hbao",
                          .source = "Pyramid HBAO, 2021, equation 8",
                          .parameters = kParameters,
                          .curve = {0, 1, 1},
                          .normal = true,
                          .directions = true,
                          .pyramid = Pyramid::kAveraged};

}  // namespace lfd::occlusion
