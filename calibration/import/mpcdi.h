// MPCDI files (VESA Multiple Projection Common Data Interchange 2.0, also 1.0), profile a3, as calibrations and back.
//
// A ZIP archive with mpcdi.xml and for every region (one projector, one module) a PFM picture that says for each of
// its pixels which point of space it lights. Points have x right as a viewer sees it, y up, z toward the viewer, in the
// region's geometricUnit, from its originOf3DData:
//   centerOfMass    of the screen's surface; on a planar screen its centre
//   idealEyePoint   on the observer line before the screen's centre
//   floorCenter     of which only the person who imports knows where it is
// A pixel with NaN in it lights nothing. Alpha, beta and distortion maps are left out, with a warning; colour
// calibrations cannot be exported.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "calibration/display.h"
#include "calibration/import/thin_warp.h"

namespace lfd {

struct MpcdiImportOptions {
  // Gives name, screen, optics, angular scattering, emitters and colour; its modules are the file's regions in their
  // order. Without it our own extension in the file gives the first four (files of export_mpcdi have it), and the
  // regions' coordinateFrame positions are the emitters.
  const DisplayCalibration* like = nullptr;
  std::optional<Point3<Physical>> origin;  // where the file's origin is, in place of what the file says
  double tolerance_m = 1e-3;               // points may be so far off the screen's surface
  ThinningWish thinning;                   // of warps with more pixels than a grid map should have nodes
};

struct MpcdiImport {
  DisplayCalibration display;
  std::vector<std::string> warnings;  // what was left out, and what thinning has lost
};

// Limits, checked before memory is taken. Warps have at most kMaxGridSide pixels a side.
inline constexpr std::size_t kMpcdiXmlLimit_bytes = std::size_t{8} << 20;
inline constexpr std::size_t kMpcdiTotalLimit_bytes = std::size_t{4} << 30;  // unpacked, of all entries

// Every map becomes a GridMap with its nodes at pixel centres. Errors name `file`, the entry and line or pixel:
// "wall.mpcdi: mpcdi.xml:12: region left: pixel (3, 7): ...".
Result<MpcdiImport> import_mpcdi(std::string_view archive, const std::string& file, const MpcdiImportOptions& options);

// Regions module-000, module-001, ..., in metres from the screen's centre of mass; every module's map is sampled at the
// centres of `size` pixels that share its image evenly (without it: the image's own), beyond the screen's border too,
// as far again as the screen is large, and rounded to float32. Errors: more than kMpcdiTotalLimit_bytes; a side of
// `size` beyond kMaxGridSide.
Result<std::string> export_mpcdi(const DisplayCalibration& display, std::optional<ImageSize> size = std::nullopt);

// Of the screen's surface, in physical space: on the z axis.
Point3<Physical> centre_of_mass(ScreenSize screen, const Optics& optics);

}  // namespace lfd
