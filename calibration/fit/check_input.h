// Which observations belong to which module, and whether a fit of them can be asked for at all.
#pragma once

#include <vector>

#include "base/result.h"
#include "calibration/display.h"
#include "calibration/fit/observations.h"

namespace lfd {

// Of one module, ordered by place, so that the order of the file makes no difference.
using ModuleObservations = std::vector<Observation>;

// One list for each module of the display. Errors name the line or the module: a module that the display does not
// have, a point outside the image, an exact repetition, a module without observations, with fewer numbers than a
// pinhole has parameters, or with all its points (nearly) on one line of the image or of the screen.
Result<std::vector<ModuleObservations>> observations_by_module(const DisplayCalibration& display,
                                                               const Observations& observations);

}  // namespace lfd
