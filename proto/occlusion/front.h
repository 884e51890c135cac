// The front of settings that nodes choose from, as it was measured (bench/results).
#pragma once

#include <string>

#include "proto/occlusion_front.pb.h"

namespace lfd::occlusion {

// Built into the program.
const proto::OcclusionFront& committed_front();

// What `asked` becomes with an entry: method, samples, parameters, and radii, blur, sharing and curve where it says
// none; all else stays its own.
proto::AmbientOcclusion with_entry(const proto::AmbientOcclusion& asked, const proto::OcclusionFront::Entry& entry);

}  // namespace lfd::occlusion
