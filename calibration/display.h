// A display's calibration: its screen, its optics and its modules; where every physical point lands in every module's
// image.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/result.h"
#include "calibration/color.h"
#include "calibration/maps/grid.h"
#include "calibration/maps/homography.h"
#include "calibration/maps/ideal.h"
#include "calibration/maps/pinhole.h"
#include "calibration/optics.h"
#include "calibration/spaces/pixel.h"

namespace lfd {

using ScreenMap = std::variant<IdealMap, HomographyMap, PinholeMap, GridMap>;

struct ModuleCalibration {
  Emitter emitter;
  ScreenMap map;
  std::optional<ColorCalibration> color = {};  // absent: the module shows sRGB as it is
  bool operator==(const ModuleCalibration&) const = default;
};

// All modules of a display have images of one size. Module k is modules[k].
struct DisplayCalibration {
  std::string name;
  ScreenSize screen;
  ImageSize image;
  Optics optics;
  double angular_scattering_rad = 0;  // > 0; the sigma of section 5 is this / 1.11741
  std::vector<ModuleCalibration> modules;
  bool operator==(const DisplayCalibration&) const = default;
};

// Limits of what is accepted, so that no file can ask for absurd memory.
inline constexpr int kMaxModules = 1024;
inline constexpr int kMaxImageSide_px = 8192;

// Checks every number; an error names the module and the field ("module 3: focal_u_px: ...").
Status validate(const DisplayCalibration& display);
// The same but for the modules, of which there may be none.
Status validate_without_modules(const DisplayCalibration& display);

// The module's map alone. Absent where the point is off the screen, has no pixel, or lands outside the image.
std::optional<PixelPoint> image_from_screen(const DisplayCalibration& display, const ModuleCalibration& module,
                                            ScreenPoint s);

// Absent outside the image and where the screen point is off the screen.
std::optional<ScreenPoint> screen_from_image(const DisplayCalibration& display, const ModuleCalibration& module,
                                             PixelPoint p);

// The map alone, also beside the image and beside the screen's borders, as far as it goes there.
std::optional<ScreenPoint> lit_by(const DisplayCalibration& display, const ScreenMap& map, PixelPoint p);

// The whole map: optics, then the module's. Absent where either is.
std::optional<ImagePoint> image_from_physical(const DisplayCalibration& display, const ModuleCalibration& module,
                                              Point3<Physical> p);

// The pixel's own line: everything it can show. Absent where the pixel has no screen point.
std::optional<PixelLine> pixel_line(const DisplayCalibration& display, const ModuleCalibration& module, PixelPoint p);

}  // namespace lfd
