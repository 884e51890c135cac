// A small MPCDI file of a vendor, whose every number is known, to change and to import.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "calibration/import/mpcdi.h"
#include "calibration/import/pfm.h"
#include "calibration/import/zip_archive.h"

namespace lfd {

// A vendor's file of one region of 30 x 20 px whose warp has 3 x 2 points, in centimetres.
inline const std::string kXml = R"(<?xml version="1.0"?>
<MPCDI profile="a3" version="2.0" date="2020-01-01">
 <display>
  <buffer id="b" Xresolution="30" Yresolution="20">
   <region id="left" Xresolution="30" Yresolution="20" x="0" y="0" xsize="1" ysize="1">
    <coordinateFrame><posx>10</posx><posy>-20</posy><posz> -150 </posz></coordinateFrame>
   </region>
  </buffer>
 </display>
 <files>
  <fileset region="left">
   <geometryWarpFile>
    <path>warps/left.pfm</path>
    <interpolation>linear</interpolation>
    <geometricUnit>cm</geometricUnit>
    <originOf3DData>centerOfMass</originOf3DData>
   </geometryWarpFile>
  </fileset>
 </files>
</MPCDI>
)";

// The same with our extension, so that no other display need be given.
inline std::string with_extension() {
  const std::string extension = R"(<extensionSet><extension Name="x"><lightFieldDisplay name="n" screenWidth="2.4"
    screenHeight="1.4" screenRadius="0" diffuser="linear" observerHeight="0" observerDistance="3" observerArc="false"
    angularScattering="0.1"/></extension></extensionSet></MPCDI>)";
  std::string text = kXml;
  return text.replace(text.find("</MPCDI>"), 8, extension);
}

// Points of the plane z = 0 in centimetres, of which no two agree in either coordinate; rows from the top.
inline PfmPixels asymmetric_warp() {
  return {3, 2, {-100, 50, 0, 10, 55, 0, 105, 60, 0, -110, -45, 0, 5, -50, 0, 100, -65, 0}};
}

inline std::string zip_of(const std::vector<ZipEntry>& entries) {
  const auto archive = write_zip(entries);
  EXPECT_TRUE(archive) << archive.error().message();
  return archive ? *archive : std::string();
}

inline std::string archive_of(const std::string& xml, const PfmPixels& warp = asymmetric_warp()) {
  return zip_of({{"mpcdi.xml", xml}, {"warps/left.pfm", print_pfm(warp)}});
}

inline std::string replaced(std::string text, const std::string& part, const std::string& replacement) {
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += replacement.size()) {
    text.replace(at, part.size(), replacement);
  }
  return text;
}

// The display that the file above is of: one module.
inline DisplayCalibration like(double screen_radius_m = 0) {
  DisplayCalibration display;
  display.name = "like";
  display.screen = {2.4, 1.4};
  display.image = {30, 20};
  display.optics.observer_height_m = 0.25;
  display.optics.observer_distance_m = 3;
  display.optics.screen_radius_m = screen_radius_m;
  display.angular_scattering_rad = 0.1;
  display.modules.push_back({{0.5, 0.25, -1}, IdealMap{}});
  return display;
}

inline Result<MpcdiImport> import_like(const std::string& archive, const DisplayCalibration& display) {
  MpcdiImportOptions options;
  options.like = &display;
  return import_mpcdi(archive, "f", options);
}

}  // namespace lfd
