// Pictures for the eye: reference, method and their difference side by side.
#pragma once

#include "bench/ao/metrics.h"
#include "proto/pictures/picture.h"

namespace lfd::bench {

// Three pictures of openness: grey, 0 black; the difference grey where there is none, red where the method is darker
// than the reference, blue where it is lighter, at full strength from 0.25 on. What has no surface is dark green.
Picture8 strip_of(const Openness& reference, const Openness& method);

}  // namespace lfd::bench
