// Bad MPCDI files say what is wrong and where; none crashes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

#include "base/log.h"
#include "tests/unit/mpcdi_files.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

std::string error_of(const std::string& archive) {
  const auto import = import_like(archive, like());
  return import ? "" : import.error().message();
}

TEST(MpcdiBad, BadXmlSaysWhatIsWrongAndWhere) {
  struct Case {
    std::string part, replacement, error;
  };
  for (const Case& c : {
           Case{"a3", "2d", "f: MPCDI: profile: \"2d\""},
           Case{"version=\"2.0\"", "version=\"3.0\"", "f: MPCDI: version: \"3.0\""},
           Case{"MPCDI", "MPCDY", "f: mpcdi.xml:1: no element MPCDI"},
           Case{"</display>", "", "f: mpcdi.xml:"},
           Case{"id=\"left\" ", "", "f: mpcdi.xml:5: region: id: is missing"},
           Case{"</region>", "</region><region id=\"left\"/>", "f: mpcdi.xml:7: region left: id: another"},
           Case{"buffer", "puffer", "f: display: no regions"},
           Case{" Yresolution=\"20\"", "", "f: mpcdi.xml:5: yResolution: is missing"},
           Case{"Xresolution=\"30\"", "Xresolution=\"30.5\"", "f: mpcdi.xml:5: xResolution: 30.5"},
           Case{"Xresolution=\"30\"", "Xresolution=\"1e9\"", "f: mpcdi.xml:5: xResolution: 1000000000"},
           Case{"Xresolution=\"30\"", "Xresolution=\"40\"", "f: regions of 40 x 20 px, but the display given"},
           Case{">10<", ">far<", "f: mpcdi.xml:6: region left: coordinateFrame: posx: \"far\""},
           Case{"<posy>-20</posy>", "", "f: mpcdi.xml:6: region left: coordinateFrame: posy: is missing"},
           Case{">cm<", ">furlong<", "f: mpcdi.xml:5: region left: geometricUnit: \"furlong\""},
           Case{"centerOfMass", "floorCenter", "f: mpcdi.xml:5: region left: originOf3DData: \"floorCenter\""},
           Case{"linear", "keystone", "f: mpcdi.xml:5: region left: interpolation: \"keystone\""},
           Case{"warps/", "other/", "f: mpcdi.xml:5: region left: other/left.pfm: no such entry"},
           Case{"warps/", "../warps/", "f: mpcdi.xml:5: region left: geometryWarpFile: path: \"../warps/left.pfm\""},
           Case{"warps/", "/warps/", "f: mpcdi.xml:5: region left: geometryWarpFile: path: \"/warps/left.pfm\""},
           Case{"warps/", "a\\..\\", "f: mpcdi.xml:5: region left: geometryWarpFile: path: "},
           Case{"<path>warps/left.pfm</path>", "", "f: mpcdi.xml:5: region left: geometryWarpFile: path: is missing"},
       }) {
    EXPECT_THAT(error_of(archive_of(replaced(kXml, c.part, c.replacement))), StartsWith(c.error)) << c.replacement;
  }
  std::string deep = "<MPCDI>";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  for (int i = 0; i < 100000; ++i) deep += "</a>";
  EXPECT_THAT(error_of(archive_of(deep + "</MPCDI>")), HasSubstr("nested deeper than 32"));
}

TEST(MpcdiBad, WhatTheDisplayCannotBeIsSaidInTheFilesWords) {
  struct Case {
    std::string part, replacement, error;
  };
  // The extension begins where </MPCDI> stood.
  const std::string line = fmt::format(
      "f: mpcdi.xml:{}: ", 1 + std::count(kXml.begin(), kXml.begin() + static_cast<int>(kXml.find("</MPCDI>")), '\n'));
  for (const Case& c : {
           Case{"screenWidth=\"2.4\"", "screenWidth=\"-1\"", line + "screenWidth: -1 must be"},
           Case{"screenHeight=\"1.4\"", "screenHeight=\"1e9\"", line + "screenHeight: 1000000000"},
           Case{"screenRadius=\"0\"", "screenRadius=\"1e-30\"", line + "screenRadius: 1e-30"},
           Case{"observerHeight=\"0\"", "observerHeight=\"1e30\"", line + "observerHeight: 1e+30"},
           Case{"observerDistance=\"3\"", "observerDistance=\"0\"", line + "observerDistance: 0 must be"},
           Case{"angularScattering=\"0.1\"", "angularScattering=\"9\"", line + "angularScattering: 9"},
           Case{"observerArc=\"false\"", "observerArc=\"maybe\"", line + "observerArc: \"maybe\""},
           Case{"observerArc=\"false\"", "observerArc=\"true\"", line + "observerArc: a planar screen"},
           Case{" observerArc=\"false\"", "", line + "observerArc: \"\""},
           Case{"> -150 <", "> 150 <", "f: mpcdi.xml:5: region left: coordinateFrame: posz: 1.5 must be negative"},
           Case{">10<", ">1e300<", "f: mpcdi.xml:5: region left: coordinateFrame: posx: "},
       }) {
    const auto bad = import_mpcdi(archive_of(replaced(with_extension(), c.part, c.replacement)), "f", {});
    ASSERT_FALSE(bad) << c.replacement;
    EXPECT_THAT(bad.error().message(), StartsWith(c.error)) << c.replacement;
  }
}

TEST(MpcdiBad, BadWarpsNameRegionAndPixel) {
  const std::string road = "f: mpcdi.xml:5: region left: warps/left.pfm: ";
  PfmPixels warp = asymmetric_warp();
  *(warp.at(1, 1) + 2) = 0.2F;  // 2 mm
  *(warp.at(2, 0) + 2) = -0.125F;
  EXPECT_EQ(error_of(archive_of(kXml, warp)),
            road + "pixel (1, 1): (5, -50, 0.2) is 0.002 m off the screen's surface; at most 0.001 m is possible");
  *warp.at(0, 1) = std::numeric_limits<float>::infinity();
  *(warp.at(0, 1) + 2) = std::numeric_limits<float>::infinity();
  EXPECT_THAT(error_of(archive_of(kXml, warp)), StartsWith(road + "pixel (0, 1): (inf, -45, inf) is inf m off"));
  EXPECT_THAT(error_of(zip_of({{"mpcdi.xml", kXml}, {"warps/left.pfm", "Pf\n1 1\n-1\n1234"}})),
              StartsWith(road + "PFM: one channel"));
  EXPECT_THAT(error_of(zip_of({{"mpcdi.xml", kXml}, {"warps/left.pfm", "PF\n1000000000 1000000000\n-1\n"}})),
              StartsWith(road + "PFM: width: 1000000000"));
  EXPECT_THAT(error_of(archive_of(kXml, {2, 2, std::vector<float>(12, kNothing)})), StartsWith(road + "no cell"));
  EXPECT_THAT(error_of(archive_of(kXml, {2, 2, std::vector<float>(12, 0)})),
              StartsWith(road + "s 0: column 0, row 0: at the same place"));
}

TEST(MpcdiBad, BadArchivesAreRefused) {
  EXPECT_THAT(error_of(""), StartsWith("f: mpcdi.xml: no such entry"));  // an archive without entries, to libzip
  EXPECT_THAT(error_of("PK\x03\x04 but nothing else"), StartsWith("f: ZIP: "));
  EXPECT_THAT(error_of(zip_of({{"other.xml", kXml}})), StartsWith("f: mpcdi.xml: no such entry"));
  // 9 MB of blanks are a small archive, but more XML than is read.
  EXPECT_THAT(error_of(zip_of({{"mpcdi.xml", std::string(9 << 20, ' ')}})), StartsWith("f: mpcdi.xml: 9437184 bytes"));
}

TEST(MpcdiBad, ArchivesUnpackNoMoreThanTheirLimits) {
  const std::string archive = zip_of({{"a", std::string(100, 'a')}, {"b", std::string(100, 'b')}});
  auto zip = ZipReader::open(archive, 150);
  ASSERT_TRUE(zip) << zip.error().message();
  EXPECT_EQ(zip->read("a", 99).error().message(), "a: 100 bytes unpacked; at most 99 are read here");
  EXPECT_EQ(*zip->read("A", 100), std::string(100, 'a'));
  EXPECT_EQ(zip->read("b", 100).error().message(), "b: 100 bytes unpacked; at most 50 are read here");
}

TEST(MpcdiBad, ExportsOfAbsurdSizeAreRefused) {
  EXPECT_THAT(export_mpcdi(like(), ImageSize{5000, 10}).error().message(), StartsWith("warps: width: 5000 px"));
  EXPECT_THAT(export_mpcdi(like(), ImageSize{10, 1}).error().message(), StartsWith("warps: height: 1 px"));
  DisplayCalibration large = like();
  large.modules.assign(100, large.modules[0]);
  EXPECT_THAT(export_mpcdi(large, ImageSize{4096, 4096}).error().message(), HasSubstr("choose a smaller size"));
}

TEST(MpcdiBad, ChangedBytesNeverCrash) {
  const std::string archive = archive_of(kXml);
  const DisplayCalibration display = like();
  std::mt19937 random(7);
  for (int round = 0; round < 5000; ++round) {
    // Half of the time within the XML, so that the archive itself is sound.
    std::string xml = kXml, bytes = archive;
    std::string& text = round % 2 == 0 ? bytes : xml;
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0) {
        text.erase(at, random() % 20);
      } else {
        text[at] = static_cast<char>(round % 2 == 0 ? random() : 32 + random() % 95);
      }
    }
    const auto import = import_like(round % 2 == 0 ? bytes : archive_of(xml), display);
    EXPECT_TRUE(import ? static_cast<bool>(validate(import->display)) : !import.error().message().empty());
  }
}

}  // namespace
}  // namespace lfd
