// Foreign calibrations: known answers by hand, and errors that name the place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/file.h"
#include "calibration/import/format.h"
#include "calibration/import/lfdisplay_yaml.h"
#include "tests/foreign_files.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view kJson = R"({
  "name": "Two", "num_projectors": 2, "image_size_x": 640, "image_size_y": 480, "observer_distance": 2000.0,
  "screen_size_x": 1000.0, "screen_size_y": 750.0, "angular_scattering": 0.1,
  "projectors_pos_x": [-100, 100], "projectors_pos_y": [0, 5], "projectors_pos_z": [-700, -710.5]
})";

constexpr std::string_view kYaml =
    "%YAML:1.0\n"
    "---\n"
    "viewerdistance: 3000.\n"
    "resolution: [ 640, 400 ]\n"
    "halfphyssize: [ 800., 450. ]\n"
    "diffusionpower: [ 900., 0. ]\n"
    "diffusertype: linear\n"
    "projectorlines:\n"
    "   - { start:[ -900., -300., 4800. ], step:[ 75., 0., 0. ], number:2 }\n"
    "   - { start:[ 0., 300., 4900. ], step:[ 0., 10., 100. ], number:3 }\n";

Result<DisplayCalibration> import_text(std::string_view text, const std::string& file) {
  const auto format = foreign_format_of(text);
  if (!format) return Error("no format");
  return import_display(*format, text, file);
}

std::string error_with(std::string_view original, std::string_view part, std::string_view replacement) {
  std::string text(original);
  EXPECT_NE(text.find(part), text.npos) << part;
  text.replace(text.find(part), part.size(), replacement);
  const auto display = import_text(text, "f");
  return display ? "" : display.error().message();
}

void expect_emitter(const ModuleCalibration& module, double x, double y, double z) {
  EXPECT_NEAR(module.emitter.x, x, 1e-15);
  EXPECT_NEAR(module.emitter.y, y, 1e-15);
  EXPECT_NEAR(module.emitter.z, z, 1e-15);
  EXPECT_TRUE(std::holds_alternative<IdealMap>(module.map));
}

TEST(Import, HolovizioModelInMetres) {
  const auto display = import_text(kJson, "f.json");
  ASSERT_TRUE(display) << display.error().message();
  EXPECT_EQ(display->name, "Two");
  EXPECT_EQ(display->screen, (ScreenSize{1, 0.75}));
  EXPECT_EQ(display->image, (ImageSize{640, 480}));
  EXPECT_EQ(display->optics, (Optics{Diffuser::kLinear, 0, 2}));
  EXPECT_EQ(display->angular_scattering_rad, 0.1);
  ASSERT_EQ(display->modules.size(), 2u);
  expect_emitter(display->modules[0], -0.1, 0, -0.7);
  expect_emitter(display->modules[1], 0.1, 0.005, -0.7105);
}

TEST(Import, LfdisplayLinesInMetresFromTheScreen) {
  const auto display = import_text(kYaml, "folder/low.yaml");
  ASSERT_TRUE(display) << display.error().message();
  EXPECT_EQ(display->name, "low");
  EXPECT_EQ(display->screen, (ScreenSize{1.6, 0.9}));
  EXPECT_EQ(display->image, (ImageSize{640, 400}));
  EXPECT_EQ(display->optics, (Optics{Diffuser::kLinear, 0, 3}));
  EXPECT_NEAR(display->angular_scattering_rad, 1.11741 / 30, 1e-15);
  ASSERT_EQ(display->modules.size(), 5u);
  expect_emitter(display->modules[0], -0.9, -0.3, -1.8);
  expect_emitter(display->modules[1], -0.825, -0.3, -1.8);
  expect_emitter(display->modules[2], 0, 0.3, -1.9);
  expect_emitter(display->modules[4], 0, 0.32, -2.1);
}

TEST(Import, BadModelsNameTheField) {
  struct Case {
    std::string_view part, replacement, error;
  };
  for (const Case& c : {
           Case{"\"name\": \"Two\",", "", "f:1: name: is missing"},
           Case{"\"Two\"", "2", "f:2: name: must be a text"},
           Case{"\"num_projectors\": 2", "\"num_projectors\": 3",
                "f:4: projectors_pos_x: 2 numbers, but num_projectors is 3"},
           Case{"\"num_projectors\": 2", "\"num_projectors\": 1e9", "f:2: num_projectors: "},
           Case{"640", "640.5", "f:2: image_size_x: 640.5"},
           Case{"480", "\"480\"", "f:2: image_size_y: must be a number, not string"},
           Case{"2000.0", "-2000.0", "f:2: observer_distance: -2 must be positive"},
           Case{"1000.0", "null", "f:3: screen_size_x: must be a number, not null"},
           Case{"750.0", "0", "f:3: screen_size_y: 0 must be positive and finite (screen: height_m)"},
           Case{"0.1", "0", "f:3: angular_scattering: "},
           Case{"[-100, 100]", "[-100, true]", "f:4: projectors_pos_x[1]: must be a number, not boolean"},
           Case{"[0, 5]", "7", "f:4: projectors_pos_y: must be a list"},
           Case{"-710.5", "710.5", "f:4: projectors_pos_z[1]: 0.7105 must be negative"},
           Case{"[-100, 100]", "[\n-100,\nfalse\n]", "f:6: projectors_pos_x[1]: must be a number"},
           Case{"[-100, 100]", "[\n-100,\n1e300\n]", "f:6: projectors_pos_x[1]: "},
           Case{"-710.5", "1e999", "f:4: projectors_pos_z[1]: must be a number that a double can hold"},
           Case{"-710.5]", "-710.5", "f: "},
       }) {
    EXPECT_THAT(error_with(kJson, c.part, c.replacement), StartsWith(std::string(c.error))) << c.replacement;
  }
}

TEST(Import, BadConfigurationsNameLineAndField) {
  struct Case {
    std::string_view part, replacement, error;
  };
  for (const Case& c : {
           Case{"viewerdistance: 3000.", "viewerdistanze: 3000.", "viewerdistance: is missing"},
           Case{"viewerdistance: 3000.", "viewerdistance: far", "f:3: viewerdistance: must be a number"},
           Case{"[ 640, 400 ]", "[ 640, 0 ]", "f:4: resolution[1]: "},
           Case{"[ 640, 400 ]", "640", "f:4: resolution: "},
           Case{"[ 800., 450. ]", "[ 800. ]", "f:5: halfphyssize: "},
           Case{"[ 800., 450. ]", "[ 800., -450. ]", "f:5: halfphyssize[1]: -0.9 must be positive"},
           Case{"[ 800., 450. ]", "[ 0., 450. ]", "f:5: halfphyssize[0]: 0 must be positive"},
           Case{"[ 900., 0. ]", "[ 1e-30, 0. ]", "f:6: diffusionpower[0]: "},
           Case{"[ 900., 0. ]", "[ -1., 0. ]", "f:6: diffusionpower[0]: "},
           Case{"linear", "round", "f:7: diffusertype: "},
           Case{"number:2", "number:0", "f:9: projectorlines[0]: number: 0"},
           Case{"number:3", "number:1100", "f:10: projectorlines[1]: number: 1100"},
           Case{"step:[ 0., 10., 100. ]", "step:[ 0., x, 100. ]", "f:10: projectorlines[1]: step[1]: must be a number"},
           Case{", number:3", "", "projectorlines[1]: number: is missing"},
           Case{"0., 300., 4900.", "0., 300., 2900.",
                "f:10: projectorlines[1]: start[2] + 0 step[2]: z: 0.1 must be negative"},
           Case{"number:2 }", "number:2", "f:"},
       }) {
    EXPECT_THAT(error_with(kYaml, c.part, c.replacement), HasSubstr(std::string(c.error))) << c.replacement;
  }
}

TEST(Import, OpencvDialectBecomesPlainYaml) {
  EXPECT_EQ(plain_yaml_of_opencv("%YAML:1.0\n---\na: { b:1, c:[ 2 ] }\n"), "\n---\na: { b: 1, c: [ 2 ] }\n");
  EXPECT_EQ(plain_yaml_of_opencv("a: \"x:y\" # n:o\nb:2"), "a: \"x:y\" # n:o\nb: 2");
  EXPECT_EQ(plain_yaml_of_opencv(""), "");
  EXPECT_EQ(plain_yaml_of_opencv("%YAML:1.0"), "");
}

TEST(Import, TellsFormatsByTheirContent) {
  EXPECT_EQ(foreign_format_of(kJson), ForeignFormat::kHolovizioJson);
  EXPECT_EQ(foreign_format_of(kYaml), ForeignFormat::kLfdisplayYaml);
  EXPECT_EQ(foreign_format_of("PK\x03\x04"), ForeignFormat::kMpcdi);
  EXPECT_EQ(foreign_format_of("name: \"desk\""), std::nullopt);
  EXPECT_EQ(foreign_format_of(""), std::nullopt);
}

TEST(Import, MutatedFilesAreReadOrRefused) {
  std::mt19937 random(3);
  for (const std::string_view original : {kJson, kYaml}) {
    for (int i = 0; i < 2000; ++i) {
      std::string text(original);
      for (unsigned changes = 1 + random() % 3; changes > 0 && !text.empty(); --changes) {
        const std::size_t at = random() % text.size();
        if (random() % 2 == 0) {
          text[at] = static_cast<char>(32 + random() % 95);
        } else {
          text.erase(at, random() % 10);
        }
      }
      for (const auto format : {ForeignFormat::kHolovizioJson, ForeignFormat::kLfdisplayYaml}) {
        const auto display = import_display(format, text, "f");
        EXPECT_TRUE(display ? static_cast<bool>(validate(*display)) : !display.error().message().empty());
      }
    }
  }
}

TEST(Import, ThePublicHolovizioModel) {
  LFD_FOREIGN_FILE(path, "displays/holovizio-21.json");
  const auto display = import_text(*read_file(path), path.string());
  ASSERT_TRUE(display) << display.error().message();
  EXPECT_EQ(display->name, "MyHoloVizio");
  EXPECT_EQ(display->screen, (ScreenSize{1, 0.6}));
  EXPECT_EQ(display->image, (ImageSize{1000, 600}));
  ASSERT_EQ(display->modules.size(), 21u);
  expect_emitter(display->modules[0], -1, 0, -0.7);
  expect_emitter(display->modules[13], 0.3, 0, -0.7);
  // The rule of thumb, 1.5 x atan(100 / 700), is what the file states.
  EXPECT_NEAR(display->angular_scattering_rad, 1.5 * std::atan(1.0 / 7), 1e-15);
}

TEST(Import, TheLfdisplayConfigurations) {
  LFD_FOREIGN_FILE(aligned_path, "displays/projectors-aligned-41.yaml");
  LFD_FOREIGN_FILE(low_path, "displays/projectors-low-25.yaml");
  const auto aligned = import_text(*read_file(aligned_path), aligned_path.string());
  const auto low = import_text(*read_file(low_path), low_path.string());
  ASSERT_TRUE(aligned && low);
  ASSERT_EQ(aligned->modules.size(), 41u);
  ASSERT_EQ(low->modules.size(), 25u);
  expect_emitter(aligned->modules[40], 1, 0, -0.4);
  expect_emitter(low->modules[24], 0.9, -0.3, -1.8);
  const auto differs = [](DisplayCalibration display) {
    DisplayCalibration linear = display;
    linear.optics.diffuser = Diffuser::kLinear;
    const double width = display.screen.width_m, height = display.screen.height_m;
    double most = 0;
    for (const ModuleCalibration& module : display.modules) {
      for (const Point3<Physical> p :
           {Point3<Physical>{0.2 * width, 0.4 * height, 0.1 * width}, {-0.1 * width, 0, -0.1 * width}}) {
        const auto a = image_from_physical(display, module, p), b = image_from_physical(linear, module, p);
        if (a && b) most = std::max(most, std::abs(a->u - b->u));
      }
    }
    return most;
  };
  EXPECT_LT(differs(*aligned), 1e-10);  // |ez| = vz and ey = vy: both diffusers agree
  EXPECT_GT(differs(*low), 1);
}

}  // namespace
}  // namespace lfd
