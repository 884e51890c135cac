// Whether what was accepted can do harm: a number that is not finite, from any map or on its way to the GPU.
#pragma once

#include <string>

#include "calibration/display.h"
#include "proto/deployment_file.h"

namespace lfd::bench {

// Empty, or what is wrong: a map that answers with a number that is not finite, parameters of the GPU that are not,
// limits in z that are not in order. `display` has been validated.
std::string harm_of(const DisplayCalibration& display);

// The same of a region of interest and settings, each valid, on this display.
std::string harm_of(const DisplayCalibration& display, const RegionOfInterest& roi, const RenderSettings& settings);

// The same of the region of interest and the settings of a deployment that has been read. Errors: those with which the
// controller refuses the region of interest once it knows a scene of 2 m, or the settings with it.
Result<std::string> harm_of(const Deployment& deployment);

}  // namespace lfd::bench
