// schmitt: Schmitt, "Screen space ambient occlusion", CSC 572, 2008.
#include "proto/occlusion/method.h"

namespace lfd::occlusion {
namespace {

constexpr Parameter kParameters[] = {
    {"range", 1, 0.01, 1000, "depth difference, in radii, at which nothing is hidden any more"},
    {"parallel", 0.95, -1, 1, "cosine between normals from which on they are too much alike"},
};

}  // namespace

extern const Method schmitt;
const Method schmitt{.name = "schmitt",
                     .source = "Schmitt, CSC 572 (2008)",
                     .parameters = kParameters,
                     .curve = {0, 1, 1},
                     .normal = true};

}  // namespace lfd::occlusion
