// The pinhole from which a module's fit starts, whatever kind of map the start has.
#pragma once

#include "base/result.h"
#include "calibration/display.h"

namespace lfd {

// A pinhole map itself; for ideal maps and grids the pinhole at the emitter that sees the screen rectangle as its
// image; for homographies the one at the emitter with their picture, but without their skew. Errors: a homography that
// mirrors or that no pinhole at the emitter can have.
Result<PinholeMap> start_pinhole(const DisplayCalibration& start, const ModuleCalibration& module);

}  // namespace lfd
