// MPCDI: what is exported is imported again, and known files have known maps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/log.h"
#include "calibration/make.h"
#include "calibration/make_color.h"
#include "tests/unit/mpcdi_files.h"

namespace lfd {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

const GridNodes& nodes_of(const DisplayCalibration& display, std::size_t k) {
  return std::get<GridMap>(display.modules[k].map).nodes();
}

TEST(Mpcdi, AForeignFileHasKnownNodes) {
  const auto import = import_like(archive_of(kXml), like());
  ASSERT_TRUE(import) << import.error().message();
  EXPECT_THAT(import->warnings, IsEmpty());
  EXPECT_EQ(import->display.name, "like");
  EXPECT_EQ(import->display.modules[0].emitter, (Emitter{0.5, 0.25, -1}));
  const GridNodes& nodes = nodes_of(import->display, 0);
  EXPECT_EQ(nodes.columns, 3);
  EXPECT_EQ(nodes.rows, 2);
  EXPECT_EQ(nodes.first_u_px, 5);  // 30 px are shared by three points, each in the middle of its share
  EXPECT_EQ(nodes.first_v_px, 5);
  EXPECT_EQ(nodes.step_u_px, 10);
  EXPECT_EQ(nodes.step_v_px, 10);
  EXPECT_DOUBLE_EQ(nodes.at(0, 0).x, -1);
  EXPECT_DOUBLE_EQ(nodes.at(2, 0).y, 0.6);
  EXPECT_DOUBLE_EQ(nodes.at(0, 1).x, -1.1);
  EXPECT_DOUBLE_EQ(nodes.at(2, 1).y, -0.65);
}

TEST(Mpcdi, VendorsSpellAndNestDifferently) {
  const std::string region_files = R"(<fileSet><GeometryWarpFile><Path>.\warps\LEFT.pfm</Path>
    <geometricunit>CM</geometricunit><originof3Ddata>CenterOfMass</originof3Ddata></GeometryWarpFile></fileSet></region>)";
  std::string nested = replaced(kXml, "</region>", region_files);
  nested.erase(nested.find("<files>"), nested.find("</files>") + 8 - nested.find("<files>"));
  const auto plain = import_like(archive_of(kXml), like());
  ASSERT_TRUE(plain);
  for (const std::string& xml :
       {replaced(kXml, "Xresolution", "xResolution"), replaced(kXml, "Xresolution", "XResolution"),
        replaced(kXml, "originOf3DData", "originof3DData"), replaced(kXml, "fileset", "fileSet"),
        replaced(kXml, "\"2.0\"", "\"1.0\""), replaced(kXml, "\"a3\"", "\"A3\""), nested}) {
    const auto import = import_like(archive_of(xml), like());
    ASSERT_TRUE(import) << import.error().message() << xml;
    EXPECT_EQ(import->display, plain->display) << xml;
  }
}

TEST(Mpcdi, UnitsAndOriginsLeadToThePhysicalSpace) {
  struct Case {
    std::string unit;
    double metre;
  };
  for (const Case& c : {Case{"mm", 1e-3}, Case{"cm", 1e-2}, Case{"dm", 0.1}, Case{"m", 1}, Case{"in", 0.0254},
                        Case{"ft", 0.3048}, Case{"yd", 0.9144}}) {
    const auto import = import_like(archive_of(replaced(kXml, ">cm<", ">" + c.unit + "<")), like());
    ASSERT_TRUE(import) << import.error().message();
    EXPECT_DOUBLE_EQ(nodes_of(import->display, 0).at(2, 0).x, 105 * c.metre) << c.unit;
  }
  // Seen from the eye the same points lie 300 cm behind it and 25 cm lower.
  PfmPixels warp = asymmetric_warp();
  for (std::size_t i = 0; i < warp.numbers.size(); i += 3) {
    warp.numbers[i + 1] -= 25;
    warp.numbers[i + 2] -= 300;
  }
  const auto import = import_like(archive_of(replaced(kXml, "centerOfMass", "idealEyePoint"), warp), like());
  ASSERT_TRUE(import) << import.error().message();
  EXPECT_NEAR(nodes_of(import->display, 0).at(2, 1).y, -0.65, 1e-15);
  // The importer knows where the floor's centre is, and his word counts.
  const DisplayCalibration display = like();
  MpcdiImportOptions options;
  options.like = &display;
  options.origin = Point3<Physical>{0, 0.25, 3};
  const auto told = import_mpcdi(archive_of(replaced(kXml, "centerOfMass", "floorCenter"), warp), "f", options);
  ASSERT_TRUE(told) << told.error().message();
  EXPECT_EQ(told->display, import->display);
}

TEST(Mpcdi, NotANumberIsAHole) {
  PfmPixels warp{3, 3, {}};
  for (int i = 0; i < 9; ++i) {
    const auto column = static_cast<float>(i % 3), row = static_cast<float>(i / 3);
    warp.numbers.insert(warp.numbers.end(), {10 * column, -10 * row, i == 2 ? kNothing : 0});
  }
  const auto import = import_like(archive_of(kXml, warp), like());
  ASSERT_TRUE(import) << import.error().message();
  const GridNodes& nodes = nodes_of(import->display, 0);
  EXPECT_TRUE(std::isnan(nodes.at(2, 0).x) && std::isnan(nodes.at(2, 0).y));
  EXPECT_EQ(nodes.at(2, 2), (ScreenPoint{0.2, -0.2}));
}

TEST(Mpcdi, PointsOfACylinderBecomeArcLengths) {
  for (const double radius : {4.0, -4.0}) {
    const DisplayCalibration display = like(radius);
    PfmPixels warp{3, 2, {}};
    const double z0 = centre_of_mass(display.screen, display.optics).z;
    for (const double y : {0.5, -0.5}) {
      for (const double s : {-1.0, 0.25, 1.125}) {
        const double x = radius * std::sin(s / radius), z = radius * (std::cos(s / radius) - 1);
        warp.numbers.insert(warp.numbers.end(), {static_cast<float>(100 * x), static_cast<float>(100 * y),
                                                 static_cast<float>(100 * (z - z0))});
      }
    }
    const auto import = import_like(archive_of(kXml, warp), display);
    ASSERT_TRUE(import) << import.error().message();
    EXPECT_NEAR(nodes_of(import->display, 0).at(0, 0).x, -1, 1e-6);  // float32 in the file
    EXPECT_NEAR(nodes_of(import->display, 0).at(2, 1).x, 1.125, 1e-6);
    EXPECT_NEAR(nodes_of(import->display, 0).at(2, 1).y, -0.5, 1e-6);
  }
}

TEST(Mpcdi, TheCentreOfMassIsTheMeanOfTheSurface) {
  EXPECT_EQ(centre_of_mass({2, 1}, like().optics), (Point3<Physical>{0, 0, 0}));
  for (const double radius : {1.0, -1.5, 1e6}) {
    const Optics optics = like(radius).optics;
    double mean = 0;
    constexpr int kSteps = 10000;
    for (int i = 0; i < kSteps; ++i) mean += surface_point(optics, {2 * ((i + 0.5) / kSteps - 0.5), 0}).z / kSteps;
    EXPECT_NEAR(centre_of_mass({2, 1}, optics).z, mean, 1e-8) << radius;  // of the midpoint rule
  }
}

TEST(Mpcdi, ExportedDisplaysComeBack) {
  auto desk = make_display("desk", 2);
  ASSERT_TRUE(desk);
  DisplayCalibration display = perturbed(*desk, 5);
  display.image = {24, 18};
  for (ModuleCalibration& module : display.modules) {
    auto& pinhole = std::get<PinholeMap>(module.map);
    for (double* const length : {&pinhole.focal_u_px, &pinhole.principal_u_px}) *length *= 24.0 / 256;
    for (double* const length : {&pinhole.focal_v_px, &pinhole.principal_v_px}) *length *= 18.0 / 192;
  }
  display.modules.push_back({{0, 0, -0.5}, IdealMap{}});
  for (const double radius : {0.0, 2.0, -2.0}) {
    display.optics.screen_radius_m = radius;
    const auto archive = export_mpcdi(display);
    ASSERT_TRUE(archive) << archive.error().message();
    const auto import = import_mpcdi(*archive, "f", {});
    ASSERT_TRUE(import) << import.error().message();
    EXPECT_THAT(import->warnings, IsEmpty());
    EXPECT_EQ(import->display.name, display.name);
    EXPECT_EQ(import->display.screen, display.screen);
    EXPECT_EQ(import->display.optics, display.optics);
    EXPECT_EQ(import->display.angular_scattering_rad, display.angular_scattering_rad);
    ASSERT_EQ(import->display.modules.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      const Emitter &was = display.modules[k].emitter, &is = import->display.modules[k].emitter;
      EXPECT_EQ(is.x, was.x);
      EXPECT_NEAR(is.z, was.z, 1e-15);  // from the centre of mass and back
      for (int row = 0; row < 18; ++row) {
        for (int column = 0; column < 24; ++column) {
          const auto s = screen_from_image(display, display.modules[k], centre_of({column, row}));
          const ScreenPoint& node = nodes_of(import->display, k).at(column, row);
          if (!s) continue;  // beside the screen
          // float32 of coordinates up to 0.2 m; on a cylinder s is computed from two of them.
          EXPECT_NEAR(node.x, s->x, 2e-8);
          EXPECT_NEAR(node.y, s->y, 1e-8);
        }
      }
    }
  }
}

TEST(Mpcdi, AGridThatIsExportedTwiceStaysWhatItWas) {
  const auto first = import_like(archive_of(kXml), like());
  ASSERT_TRUE(first);
  const auto archive = export_mpcdi(first->display, ImageSize{3, 2});
  ASSERT_TRUE(archive);
  const auto second = import_mpcdi(*archive, "f", {});
  ASSERT_TRUE(second) << second.error().message();
  const GridNodes &a = nodes_of(first->display, 0), &b = nodes_of(second->display, 0);
  ASSERT_EQ(a.node.size(), b.node.size());
  for (std::size_t i = 0; i < a.node.size(); ++i) {
    EXPECT_EQ(b.node[i].x, static_cast<float>(a.node[i].x));
    EXPECT_EQ(b.node[i].y, static_cast<float>(a.node[i].y));
  }
  EXPECT_EQ(*export_mpcdi(second->display, ImageSize{3, 2}), *archive);
}

TEST(Mpcdi, LargeWarpsAreThinnedWithAWarning) {
  PfmPixels warp{11, 5, {}};
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 11; ++column) {
      warp.numbers.insert(warp.numbers.end(),
                          {10.0F * static_cast<float>(column), -10.0F * static_cast<float>(row), 0});
    }
  }
  const DisplayCalibration display = like();
  MpcdiImportOptions options;
  options.like = &display;
  options.thinning.most_nodes = 4;
  const auto import = import_mpcdi(archive_of(kXml, warp), "f", options);
  ASSERT_TRUE(import) << import.error().message();
  EXPECT_THAT(import->warnings, ElementsAre("warps of 11 x 5 points were thinned to 4 x 4 (in 1 of 1 regions)",
                                            StartsWith("thinning moved points by up to ")));
  const GridNodes& nodes = nodes_of(import->display, 0);
  // From the first pixel's centre to the last one's; linear between, which is exact here.
  EXPECT_DOUBLE_EQ(nodes.place(3, 3).x, 30 * 10.5 / 11);
  EXPECT_DOUBLE_EQ(nodes.place(3, 3).y, 20 * 4.5 / 5);
  EXPECT_DOUBLE_EQ(nodes.at(1, 0).x, 1.0 / 3);
  EXPECT_DOUBLE_EQ(nodes.at(3, 1).x, 1);
  EXPECT_DOUBLE_EQ(nodes.at(3, 1).y, -0.4 / 3);
}

TEST(Mpcdi, OtherMapsAreLeftOutWithAWarning) {
  const auto import = import_like(
      archive_of(replaced(kXml, "</geometryWarpFile>", "</geometryWarpFile><alphaMap/><betaMap/>")), like());
  ASSERT_TRUE(import);
  EXPECT_THAT(import->warnings, ElementsAre("alphaMap is not imported (in 1 of 1 regions)",
                                            "betaMap is not imported (in 1 of 1 regions)"));
}

TEST(Mpcdi, WhatTheFileDoesNotSayIsAskedFor) {
  EXPECT_THAT(import_mpcdi(archive_of(kXml), "f", {}).error().message(), HasSubstr("a display like it must be given"));
  const std::string whole = with_extension();
  const auto import = import_mpcdi(archive_of(whole), "f", {});
  ASSERT_TRUE(import) << import.error().message();
  EXPECT_EQ(import->display.modules[0].emitter, (Emitter{0.1, -0.2, -1.5}));
  const auto no_frame = replaced(replaced(whole, "<coordinateFrame>", "<x>"), "</coordinateFrame>", "</x>");
  EXPECT_THAT(import_mpcdi(archive_of(no_frame), "f", {}).error().message(),
              AllOf(StartsWith("f: mpcdi.xml:5: region left: "), HasSubstr("where the emitter is")));
  EXPECT_THAT(import_mpcdi(archive_of(replaced(whole, "linear\" obs", "round\" obs")), "f", {}).error().message(),
              HasSubstr("diffuser: \"round\""));
}

// MPCDI has no place for it; who imports with the display that was exported keeps it.
TEST(Mpcdi, TheDisplayGivenGivesItsColourToo) {
  DisplayCalibration display = like();
  display.modules[0].color = colored(display, 3).modules[0].color;
  const auto import = import_like(archive_of(kXml), display);
  ASSERT_TRUE(import) << import.error().message();
  EXPECT_EQ(import->display.modules[0].color, display.modules[0].color);
  EXPECT_TRUE(import->display.modules[0].color);
}

// A warp has a number for the middle of each of its pixels: beyond the outermost nobody knows a map.
TEST(Mpcdi, ASmallerWarpLosesHalfItsPixelAlongTheBorder) {
  const DisplayCalibration display = *make_display("desk", 1);
  const ImageSize quarter{display.image.width / 4, display.image.height / 4};
  const auto archive = export_mpcdi(display, quarter);
  ASSERT_TRUE(archive) << archive.error().message();
  const auto import = import_mpcdi(*archive, "f", {});
  ASSERT_TRUE(import) << import.error().message();
  const auto lit = [](const DisplayCalibration& of, double u, double v) {
    return lit_by(of, of.modules[0].map, PixelPoint{u, v});
  };
  const double middle = 0.5 * display.image.height, right = display.image.width;
  for (const double u : {0.5, 1.5, right - 1.5, right - 0.5}) {
    EXPECT_TRUE(lit(display, u, middle)) << u;
    EXPECT_FALSE(lit(import->display, u, middle)) << u;
  }
  for (const double u : {2.5, right - 2.5}) {
    const auto before = lit(display, u, middle), after = lit(import->display, u, middle);
    ASSERT_TRUE(before && after) << u;
    EXPECT_NEAR(after->x, before->x, 1e-5);
  }
}

}  // namespace
}  // namespace lfd
