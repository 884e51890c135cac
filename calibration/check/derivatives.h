// How a map stretches: its derivatives by differences, and their condition numbers.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <optional>

#include "calibration/display.h"

namespace lfd {

// Derivative of the module's map against the ideal one, both in metres on the screen: the identity for the ideal map,
// a negative determinant where the map mirrors. Absent at the map's border.
std::optional<glm::dmat2> derivative_by_screen(const DisplayCalibration& display, const ModuleCalibration& module,
                                               ScreenPoint s);

// Derivative of (image, depth) by physical space, all in metres: the image scaled to the screen as the ideal map does,
// the depth of calibration/optics.h. Absent at the border.
std::optional<glm::dmat3> derivative_by_physical(const DisplayCalibration& display, const ModuleCalibration& module,
                                                 Point3<Physical> p);

// |m| |m^-1| / dimension by Frobenius' norm: 1 for rotations, infinite for singular matrices.
double condition_number(const glm::dmat2& m);
double condition_number(const glm::dmat3& m);

// Of derivative_by_physical. A shear by the pixel's own line is part of it: for the linear diffuser and the ideal map
// at z = 0 it is (3 + (dx/ez)^2 + (dy/vz)^2) / 3 with the distances dx from the emitter and dy from the observer's
// height.
std::optional<double> condition_at(const DisplayCalibration& display, const ModuleCalibration& module,
                                   Point3<Physical> p);

// The point `distance_m` before (> 0) or behind the screen's surface at `s`, along its normal; planar: (s, y,
// distance).
Point3<Physical> point_before_screen(const Optics& optics, ScreenPoint s, double distance_m);

}  // namespace lfd
