// What an eye before the virtual display sees (design geometry, section 5).
#pragma once

#include <span>

#include "base/result.h"
#include "calibration/display.h"
#include "proto/pictures/picture.h"

namespace lfd::display {

using Eye = Point3<Physical>;  // z > 0

// The weight of a module in what `eye` sees at `s`, as its natural logarithm (never above 0), so that it cannot
// underflow:
//   linear:   -(dtheta / sigma)^2, dtheta between the horizontal directions emitter -> s and s -> eye
//   conical:  -((rho_in - rho_out) / sigma)^2;   sigma = angular_scattering_rad / 1.11741
double log_weight(const DisplayCalibration& display, const ModuleCalibration& module, ScreenPoint s, const Eye& eye);

// How far the eye is from the nearest direction that any module sends light in, over the whole screen: radians of a
// linear diffuser, differences of rho (about radians) of a conical one. Beyond a few times the angular scattering
// nobody would see anything of a real display.
double nearest_light_rad(const DisplayCalibration& display, const Eye& eye);

// The screen as `eye` sees it, rectified (of a curved one, unrolled): pixel (i, j) is the screen point ((i + 0.5) /
// width_px - 0.5, 0.5 - (j + 0.5) / height_px) times the screen's size. images[m] is the colour image of module m
// (what it is fed, rows from the top), of the display's image size; null where there is none. The light that modules
// emit (display/module_light.h) is blended linearly, each channel divided by the sum of weights times gains. Modules
// without an image, and without a pixel or with a gain of 0 at a point, are left out of it; where none is left it is
// black. Alpha is 255. Runs on all cores. Errors: not one entry per module, an image of another size, an eye that is
// not before the screen, a size of 0 or absurd.
Result<Picture8> viewer_picture(const DisplayCalibration& display, std::span<const Picture8* const> images,
                                const Eye& eye, int width_px, int height_px);

}  // namespace lfd::display
