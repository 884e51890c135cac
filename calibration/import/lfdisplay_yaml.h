// LFDisplay configurations, YAML in OpenCV's dialect and millimetres (design geometry, section 7).
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "calibration/display.h"

namespace lfd {

// Fields: viewerdistance, resolution [w, h], halfphyssize [w/2, h/2], diffusionpower [p, 0], diffusertype (linear or
// conical), projectorlines, a list of {start [x, y, z], step [x, y, z], number}. The name is the file's stem. The
// file's origin is the viewer and its z points away from him: physical z = viewerdistance - z. Ideal maps, observer
// line at height 0; modules in the order of the lines. Other fields are ignored. The file weighs a module by exp(-p
// (rho_in - rho_out)^2), hence sigma = 1 / sqrt(p), and by section 5 of the design angular_scattering = 1.11741 sigma.
// Errors name file, line and field: "file:9: projectorlines[0]: number: must be ...".
Result<DisplayCalibration> import_lfdisplay_yaml(std::string_view text, const std::string& file);

// The text as plain YAML, line by line: the directive line becomes empty, and a space follows the colon of every key.
std::string plain_yaml_of_opencv(std::string_view text);

}  // namespace lfd
