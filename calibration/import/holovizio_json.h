// The public HoloVizio display model, a JSON file in millimetres (design geometry, section 7).
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "calibration/display.h"

namespace lfd {

// Fields: name, num_projectors, image_size_x, image_size_y, observer_distance, screen_size_x, screen_size_y,
// angular_scattering (rad), projectors_pos_x, _y, _z (z < 0 behind the screen). Linear diffuser, ideal maps, observer
// line at height 0; modules in the file's order. Other fields are ignored. Errors begin with `file` and name line and
// field: "file:12: projectors_pos_x[3]: must be a number".
Result<DisplayCalibration> import_holovizio_json(std::string_view text, const std::string& file);

}  // namespace lfd
