// The XML part of MPCDI files (VESA Multiple Projection Common Data Interchange), in and out; the one door of pugixml.
//
// Names of elements and attributes are compared without regard to case, as vendors spell them differently
// (Xresolution, xResolution, XResolution; fileset, fileSet). A region's files are looked for in files/fileset with its
// id, and in the region itself.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "calibration/display.h"

namespace lfd {

// One region of a buffer: one projector. Texts are as they stand in the file; they are empty where it has none.
struct MpcdiRegion {
  std::string id;
  int line = 0;
  ImageSize resolution;
  std::optional<Point3<Physical>> position;  // of coordinateFrame, in the warp's unit and axes, from its origin
  std::string warp_path, warp_unit, warp_origin, warp_interpolation;
  std::vector<std::string> other_maps;  // alphaMap, betaMap, distortionMap: those that are there
};

// What MPCDI has no words for, and our files say in an extension.
struct MpcdiExtension {
  std::string name;
  ScreenSize screen;
  Optics optics;
  double angular_scattering_rad = 0;
  int line = 0;
};

struct MpcdiDocument {
  std::string profile, version;
  std::vector<MpcdiRegion> regions;  // of all buffers, in the order of the file
  std::optional<MpcdiExtension> extension;
};

inline constexpr int kMaxXmlDepth = 32;

// Errors name line, element and attribute: "12: region left: xResolution: ...". Refuses XML that is not well-formed or
// nested deeper than kMaxXmlDepth, regions without an id or with one that was used before, and more than kMaxModules.
Result<MpcdiDocument> parse_mpcdi_xml(std::string_view text);

// Text that parses to an equal document, apart from lines; regions in one buffer, of which each is the whole.
std::string print_mpcdi_xml(const MpcdiDocument& document);

}  // namespace lfd
