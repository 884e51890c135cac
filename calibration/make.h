// Displays made by name, in the class of published ones, and the errors that real installations have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "calibration/display.h"

namespace lfd {

// The names that make_display knows (design geometry, section 6).
std::vector<std::string> display_names();

// A display with ideal maps: emitters span +-|ez| tan(fov/2) at equal pitch, in ascending x. `modules` replaces their
// number, within the same span. Lengths are rounded to 1e-12 m, so that all machines make the same display.
Result<DisplayCalibration> make_display(std::string_view name, std::optional<int> modules = std::nullopt);

// The rule of thumb: 1.5 x the angle, in radians, between the two emitters in the middle of the row, seen from the
// screen's centre. Needs at least two modules.
double scattering_by_rule_rad(std::span<const ModuleCalibration> modules);

// The pinhole at `emitter`, unturned, without distortion, that agrees with the ideal map: a lens shifted as far as
// needed.
PinholeMap pinhole_of_ideal(ScreenSize screen, ImageSize image, const Emitter& emitter);

// The same display as if it had been installed by hand: every ideal map becomes a pinhole with its own errors of
// position (mm), rotation (tenths of a degree), focal lengths, principal point (tenths of a percent), and a lens that
// moves pixels by up to about 1.5 % of the image's width. The emitter moves with the pinhole. Other maps stay as they
// are. Equal seeds give equal displays.
DisplayCalibration perturbed(const DisplayCalibration& display, std::uint64_t seed);

// The same display as if it had been measured: every map becomes a grid of columns x rows nodes over the image, each
// where the map and a smooth warp of its own, of up to about `bump_px` pixels, put it; holes where the map has none.
// The screen is taken to go on beside its borders, so that images that reach beyond it have nodes there. Errors: less
// than 2 or more than kMaxGridSide nodes a side, more than kMostMeasured of all modules, those of GridMap::make, with
// the module.
inline constexpr std::size_t kMostMeasured = std::size_t{1} << 24;
Result<DisplayCalibration> measured(const DisplayCalibration& display, int columns, int rows, double bump_px,
                                    std::uint64_t seed);

// The same display with its screen bent to a cylinder (Optics: screen_radius_m, observer_arc) and its emitters moved
// along, pinholes with them, so that each stands to the screen as before. Errors: a radius of 0, those of validate().
Result<DisplayCalibration> curved(const DisplayCalibration& display, double radius_m, bool observer_arc);

}  // namespace lfd
