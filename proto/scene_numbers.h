// Whether the numbers of a scene are such that light and places stay finite in single precision.
#pragma once

#include "base/result.h"
#include "proto/wire.pb.h"

namespace lfd {

// Errors name the place: "light 2: range_m: -1; 0 to 1e+15 are possible". Refuses what is not finite in placements,
// materials and lights; light of a negative amount or of more than 1e30; lights and ranges farther than 1e15 m;
// directional lights and spots without a direction; cones that are not 0 <= inner < outer <= pi / 2; unknown kinds.
Status check_numbers(const proto::Scene& scene);

// The same of what an update moves, and of nothing else.
Status check_moved_numbers(const proto::Update& update);

}  // namespace lfd
