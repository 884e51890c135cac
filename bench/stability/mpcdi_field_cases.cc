// Bad numbers in MPCDI archives: in their XML, and in their warps.
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/log.h"
#include "bench/stability/file_fields.h"
#include "bench/stability/groups.h"
#include "bench/stability/harmless.h"
#include "calibration/import/mpcdi.h"
#include "calibration/import/pfm.h"
#include "calibration/import/zip_archive.h"

namespace lfd::bench {
namespace {

// A region of 30 x 20 pixels on its third line, with a warp of 3 x 2 points; our extension on its sixth.
constexpr const char* kXml =
    "<MPCDI profile=\"a3\" version=\"2.0\">\n"
    "<display><buffer id=\"b\">\n"
    "<region id=\"r\" xResolution=\"30\" yResolution=\"20\"><coordinateFrame>"
    "<posx>0.1</posx><posy>-0.2</posy><posz>-1.5</posz></coordinateFrame></region>\n"
    "</buffer></display>\n"
    "<files><fileset region=\"r\"><geometryWarpFile>"
    "<path>w.pfm</path><interpolation>linear</interpolation>"
    "<geometricUnit>m</geometricUnit><originOf3DData>centerOfMass</originOf3DData>"
    "</geometryWarpFile></fileset></files>\n"
    "<extensionSet><extension Name=\"LightFieldDisplay\"><lightFieldDisplay name=\"n\" screenWidth=\"2.4\""
    " screenHeight=\"1.4\" screenRadius=\"0\" diffuser=\"linear\" observerHeight=\"0.25\" observerDistance=\"3\""
    " observerArc=\"false\" angularScattering=\"0.1\"/></extension></extensionSet>\n"
    "</MPCDI>\n";

PfmPixels sound_warp() {
  return {3, 2, {-1, 0.5F, 0, 0.1F, 0.55F, 0, 1.05F, 0.6F, 0, -1.1F, -0.45F, 0, 0.05F, -0.5F, 0, 1, -0.65F, 0}};
}

// A display given with the archive gives what the extension says, and the emitters: positions and extension are read
// and checked, but change nothing. Without it every number counts.
enum class Given { kDisplay, kNothing };

const char* title_of(Given given) { return given == Given::kDisplay ? "MPCDI with a display like it: " : "MPCDI: "; }

DisplayCalibration like() {
  DisplayCalibration display{"like", {2.4, 1.4}, {30, 20}, {Diffuser::kLinear, 0.25, 3, 0, false}, 0.1, {}};
  display.modules.push_back({{0.5, 0.25, -1}, IdealMap{}});
  return display;
}

Result<std::string> harm_of_archive(Given given, const std::string& xml, const PfmPixels& warp) {
  const std::array<ZipEntry, 2> entries{{{"mpcdi.xml", xml}, {"w.pfm", print_pfm(warp)}}};
  LFD_TRY(const std::string archive, write_zip(entries));
  const DisplayCalibration display = like();
  MpcdiImportOptions options;
  if (given == Given::kDisplay) options.like = &display;
  LFD_TRY(const MpcdiImport imported, import_mpcdi(archive, "f.mpcdi", options));
  return harm_of(imported.display);
}

StabilityCase xml_case(Given given, const std::string& field, const std::string& before, char end) {
  const TextSlot slot = slot_of(kXml, before, end);
  std::vector<std::string> words{field};
  std::string beginning = fmt::format("f.mpcdi: mpcdi.xml:{}: ", slot.line());
  if (field == "screenRadius") {
    // A radius that a screen may have makes the points of a flat warp wrong: they are not on the cylinder.
    words.emplace_back("w.pfm");
    beginning = "f.mpcdi: mpcdi.xml:#: ";
  }
  return field_case(kTextGroup, {title_of(given) + field,
                                 slot.sound,
                                 {kBadTexts.begin(), kBadTexts.end()},
                                 words,
                                 beginning,
                                 [given, slot](const std::string& value) {
                                   return harm_of_archive(given, slot.with(value), sound_warp());
                                 }});
}

StabilityCase warp_case(Given given, std::size_t number) {
  return field_case(kTextGroup, {fmt::format("{}warp, number {}", title_of(given), number),
                                 fmt::format("{}", sound_warp().numbers[number]),
                                 {kBadFloats.begin(), kBadFloats.end()},
                                 {"w.pfm"},
                                 "f.mpcdi: mpcdi.xml:3: region r: w.pfm: ",
                                 [given, number](const std::string& value) {
                                   PfmPixels warp = sound_warp();
                                   warp.numbers[number] = std::strtof(value.c_str(), nullptr);
                                   return harm_of_archive(given, kXml, warp);
                                 }});
}

}  // namespace

void add_mpcdi_field_cases(StabilityCases& cases) {
  for (const Given given : {Given::kDisplay, Given::kNothing}) {
    for (const std::string field : {"posx", "posy", "posz"})
      cases.push_back(xml_case(given, field, "<" + field + ">", '<'));
    for (const std::string field :
         {"xResolution", "yResolution", "screenWidth", "screenHeight", "screenRadius", "diffuser", "observerHeight",
          "observerDistance", "observerArc", "angularScattering"}) {
      cases.push_back(xml_case(given, field, field + "=\"", '"'));
    }
    for (const std::size_t number : {0, 4, 17}) cases.push_back(warp_case(given, number));
  }
}

}  // namespace lfd::bench
