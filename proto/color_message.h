// Colour calibrations of modules as messages (schema: proto/calibration.proto).
#pragma once

#include "base/result.h"
#include "calibration/color.h"
#include "proto/calibration.pb.h"

namespace lfd {

// Checks that the numbers are there, not what they are: validate() does. Errors begin with the field.
Result<ColorCalibration> read_color(const proto::ColorCalibration& message);

// The message that read_color turns into an equal calibration.
proto::ColorCalibration write_color(const ColorCalibration& color);

}  // namespace lfd
