// What the observations say about each parameter, and what only the prior does.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "calibration/fit/pinhole_fit.h"

namespace lfd {

struct Determined {
  // Of each module: names of the parameters whose variance the observations do not even halve; the start's values
  // hold these.
  std::vector<std::vector<std::string>> held_by_start;
  double curvature_sd = 0;  // of the logarithm of the screen's curvature, from observations and prior; 0: planar
};

// Eight combinations of a module's parameters place its picture of the screen, as a homography does; each must be known
// better from the observations than from the prior. An error names the module and the parameter that is not.
Result<Determined> determined_by(std::span<const PinholeFamily> families, std::span<const ModuleObservations> modules,
                                 double start_curvature, const PinholeFit& fit);

}  // namespace lfd
