// Calibration files: the round trip, every bad field by file, line, module and name, and mutated texts.
#include "proto/calibration_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "base/file.h"
#include "base/log.h"
#include "calibration/make.h"
#include "proto/text_file.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// One module of each kind of map; line numbers below are those of this text.
constexpr std::string_view kText =
    "name: \"three\"\n"                                                                  // 1
    "screen { width_m: 0.4\n height_m: 0.3 }\n"                                          // 2, 3
    "image { width_px: 256\n height_px: 192 }\n"                                         // 4, 5
    "optics { diffuser: LINEAR\n observer_height_m: 0.1\n observer_distance_m: 0.8 }\n"  // 6, 7, 8
    "angular_scattering_rad: 0.15\n"                                                     // 9
    "module { emitter { x: 0.1 z: -0.6 } ideal {} }\n"                                   // 10
    "module { emitter { z: -0.6 }\n"                                                     // 11
    " homography { h: [640, 0, 128, 0, -640, 96, 0, 0, 1] } }\n"                         // 12
    "module {\n emitter { x: -0.1 z: -0.6 }\n"                                           // 13, 14
    " pinhole {\n  position { x: -0.1 z: -0.6 }\n"                                       // 15, 16
    "  orientation { w: 1 }\n"                                                           // 17
    "  focal_u_px: 384\n  focal_v_px: 385\n"                                             // 18, 19
    "  principal_u_px: 64\n  principal_v_px: 96\n"                                       // 20, 21
    "  k1: 0.01\n  k2: 0.02\n  k3: 0.03\n  p1: 0.04\n  p2: 0.05 } }\n";                  // 22 to 26

// The folder of one test, gone when it ends.
class CalibrationFile : public testing::Test {
 protected:
  CalibrationFile() {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("calibration-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  ~CalibrationFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file() const { return folder_ / "wall.textproto"; }

  // The error, without its folder, of loading kText with one part replaced.
  std::string error_with(std::string_view part, std::string_view replacement) {
    std::string text(kText);
    const auto at = text.find(part);
    EXPECT_NE(at, text.npos) << part;
    text.replace(at, part.size(), replacement);
    EXPECT_TRUE(write_file(file(), text));
    const auto display = load_calibration(file());
    if (display) return "";
    const std::string& message = display.error().message();
    EXPECT_THAT(message, StartsWith(folder_.string() + "/"));
    return message.substr(folder_.string().size() + 1);
  }

  std::filesystem::path folder_;
};

TEST_F(CalibrationFile, IsReadFieldByField) {
  ASSERT_TRUE(write_file(file(), kText));
  const auto display = load_calibration(file());
  ASSERT_TRUE(display) << display.error().message();
  EXPECT_EQ(display->name, "three");
  EXPECT_EQ(display->screen, (ScreenSize{0.4, 0.3}));
  EXPECT_EQ(display->image, (ImageSize{256, 192}));
  EXPECT_EQ(display->optics, (Optics{Diffuser::kLinear, 0.1, 0.8}));
  EXPECT_EQ(display->angular_scattering_rad, 0.15);
  ASSERT_EQ(display->modules.size(), 3u);
  EXPECT_EQ(display->modules[0], (ModuleCalibration{{0.1, 0, -0.6}, IdealMap{}}));
  EXPECT_EQ(display->modules[1].map, ScreenMap(HomographyMap{glm::dmat3({640, 0, 0}, {0, -640, 0}, {128, 96, 1})}));
  const PinholeMap pinhole{{-0.1, 0, -0.6}, {1, 0, 0, 0}, 384, 385, 64, 96, 0.01, 0.02, 0.03, 0.04, 0.05};
  EXPECT_EQ(display->modules[2].map, ScreenMap(pinhole));
}

TEST_F(CalibrationFile, LoadsWhatWasSaved) {
  for (const std::string& name : display_names()) {
    for (const std::uint64_t seed : {1u, 2u}) {
      const DisplayCalibration display = perturbed(*make_display(name), seed);
      ASSERT_TRUE(save_calibration(file(), display));
      const auto loaded = load_calibration(file());
      ASSERT_TRUE(loaded) << loaded.error().message();
      EXPECT_EQ(*loaded, display);
      EXPECT_EQ(calibration_hash(*loaded), calibration_hash(display));
    }
  }
}

TEST_F(CalibrationFile, RandomNumbersSurviveTheRoundTrip) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  DisplayCalibration display = *make_display("desk");
  for (auto& module : display.modules) {
    module.emitter = {any(random) * 1e-9, any(random) * 1e6, -std::exp(13 * any(random))};
    module.map =
        HomographyMap{glm::dmat3({any(random), any(random), any(random)}, {any(random), any(random), any(random)},
                                 {any(random), any(random), any(random)})};
  }
  ASSERT_TRUE(save_calibration(file(), display));
  const auto loaded = load_calibration(file());
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_EQ(*loaded, display);
}

TEST_F(CalibrationFile, EveryBadFieldIsNamedWithItsLine) {
  struct Case {
    std::string_view part, replacement, error;
  };
  const Case cases[] = {
      {"width_m: 0.4", "width_m: 0", ":2: screen: width_m: "},
      {"height_m: 0.3", "height_m: nan", ":3: screen: height_m: "},
      {"width_px: 256", "width_px: -1", ":4: image: width_px: "},
      {"height_px: 192", "height_px: 8193", ":5: image: height_px: "},
      {"diffuser: LINEAR", "", ":6: optics: diffuser: "},
      {"diffuser: LINEAR", "diffuser: UNSPECIFIED", ":6: optics: diffuser: "},
      {"observer_height_m: 0.1", "observer_height_m: inf", ":7: optics: observer_height_m: "},
      {"observer_distance_m: 0.8", "observer_distance_m: -0.8", ":8: optics: observer_distance_m: "},
      {"angular_scattering_rad: 0.15", "angular_scattering_rad: 0", ":9: angular_scattering_rad: "},
      {"emitter { x: 0.1 z: -0.6 } ideal {}", "ideal {}", ":10: module 0: emitter: is missing"},
      {"emitter { x: 0.1 z: -0.6 } ideal {}", "emitter { z: -1 }", ":10: module 0: one of ideal"},
      {"emitter { x: 0.1 z: -0.6 }", "emitter { x: nan z: -0.6 }", ":10: module 0: emitter: "},
      {"emitter { z: -0.6 }", "emitter { z: 0.6 }", ":11: module 1: emitter: "},
      {"h: [640, 0, 128, 0, -640, 96, 0, 0, 1]", "h: [1, 2]", ":12: module 1: homography: h: 2 numbers"},
      {"h: [640, 0, 128, 0, -640, 96, 0, 0, 1]", "h: [1, 1, 1, 1, 1, 1, 0, 0, 1]", ":12: module 1: homography: h: "},
      {"position { x: -0.1 z: -0.6 }", "", ":15: module 2: pinhole: position: is missing"},
      {"position { x: -0.1 z: -0.6 }", "position { x: inf }", ":16: module 2: pinhole: position: "},
      {"orientation { w: 1 }", "orientation { w: 0.9997 }", ":17: module 2: pinhole: orientation: "},
      {"orientation { w: 1 }", "", ":15: module 2: pinhole: orientation: is missing"},
      {"focal_u_px: 384", "focal_u_px: 0", ":15: module 2: pinhole: focal_u_px: "},  // 0 is as if it were not there
      {"focal_v_px: 385", "focal_v_px: -3", ":19: module 2: pinhole: focal_v_px: "},
      {"principal_u_px: 64", "principal_u_px: nan", ":20: module 2: pinhole: principal_u_px: "},
      {"principal_v_px: 96", "principal_v_px: inf", ":21: module 2: pinhole: principal_v_px: "},
      {"k1: 0.01", "k1: nan", ":22: module 2: pinhole: k1: "},
      {"k2: 0.02", "k2: nan", ":23: module 2: pinhole: k2: "},
      {"k3: 0.03", "k3: nan", ":24: module 2: pinhole: k3: "},
      {"p1: 0.04", "p1: nan", ":25: module 2: pinhole: p1: "},
      {"p2: 0.05", "p2: -inf", ":26: module 2: pinhole: p2: "},
      {"k1: 0.01", "k9: 0.01", ":22: "},
      {"module {\n", "modul {\n", ":13: "},
  };
  for (const Case& c : cases) {
    const std::string error = error_with(c.part, c.replacement);
    // A number that is 0 has no place of its own in proto3's eyes; both lines are right.
    if (c.replacement == "focal_u_px: 0") {
      EXPECT_THAT(error, HasSubstr("module 2: pinhole: focal_u_px: "));
      continue;
    }
    EXPECT_THAT(error, StartsWith(fmt::format("wall.textproto{}", c.error))) << c.replacement;
  }
}

// Numbers of a point, and nodes of a grid, have lines and names of their own.
TEST_F(CalibrationFile, NestedNumbersAreNamedWithTheirOwnLine) {
  const auto error = [&](std::string_view replacement) {
    return error_with("emitter { x: 0.1 z: -0.6 } ideal {}", replacement);
  };
  EXPECT_THAT(error("emitter {\n x: 0.1\n y: nan\n z: -0.6 } ideal {}"),
              StartsWith("wall.textproto:12: module 0: emitter: y: nan"));
  EXPECT_THAT(error("emitter {\n x: 1e30\n z: -0.6 } ideal {}"),
              StartsWith("wall.textproto:11: module 0: emitter: x: 1e+30"));
  EXPECT_THAT(error("emitter {\n x: 0.1\n z: 0.6 } ideal {}"),
              StartsWith("wall.textproto:12: module 0: emitter: z: 0.6"));
  EXPECT_THAT(error_with("position { x: -0.1 z: -0.6 }", "position { x: -0.1\n y: inf\n z: -0.6 }"),
              StartsWith("wall.textproto:17: module 2: pinhole: position: y: inf"));
  EXPECT_THAT(error("emitter { z: -0.6 } grid { columns: 2 rows: 2 step_u_px: 1 step_v_px: 1\n s: -1\n s: 1\n s: -1\n"
                    " s: 1e30\n y: 1\n y: 1\n y: -1\n y: -1 }"),
              StartsWith("wall.textproto:14: module 0: grid: s 3: column 1, row 1: 1e+30 m"));
}

TEST_F(CalibrationFile, WithoutModulesIsRefused) {
  std::string text(kText);
  ASSERT_TRUE(write_file(file(), text.substr(0, text.find("module"))));
  EXPECT_THAT(load_calibration(file()).error().message(), HasSubstr("wall.textproto: module: 0 of them"));
}

TEST_F(CalibrationFile, MutatedTextsAreReadOrRefusedButNeverTrusted) {
  std::mt19937 random(5);
  const std::string original(kText);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = original;
    for (unsigned changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size(), length = std::min<std::size_t>(random() % 12, text.size() - at);
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, original.substr(random() % original.size(), length));
          break;
        default:
          text.insert(at, std::string("0123456789-.e{}[]\"\n").substr(random() % 19, 1));
          break;
      }
      if (text.empty()) text.push_back('#');
    }
    proto::DisplayCalibration message;
    if (!parse_text(text, "f", message)) {
      ++refused;
      continue;
    }
    const auto display = read_calibration(message);
    if (!display) {
      ++refused;
      continue;
    }
    ++accepted;
    EXPECT_TRUE(validate(*display));
    for (const ModuleCalibration& module : display->modules) {
      const auto p = image_from_physical(*display, module, {0.01, 0.02, 0.03});
      EXPECT_TRUE(!p || (std::isfinite(p->u) && std::isfinite(p->v)));
    }
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 1000);
}

TEST(CalibrationHash, ChangesWithEveryNumber) {
  const DisplayCalibration display = *make_display("desk");
  DisplayCalibration other = display;
  other.modules[3].emitter.x = std::nextafter(other.modules[3].emitter.x, 1);
  EXPECT_NE(calibration_hash(display), calibration_hash(other));
  EXPECT_EQ(calibration_hash(display), calibration_hash(*make_display("desk")));
}

TEST(CommittedDisplays, AreWhatTheToolMakes) {
  const std::filesystem::path folder = std::filesystem::path(LFD_SOURCE_DIR) / "configs" / "displays";
  std::vector<std::pair<std::string, DisplayCalibration>> made = {
      {"desk-perturbed", perturbed(*make_display("desk"), 1)}};
  for (const std::string& name : display_names()) made.emplace_back(name, *make_display(name));
  for (const auto& [name, display] : made) {
    const auto text = read_file(folder / (name + ".textproto"));
    ASSERT_TRUE(text) << text.error().message();
    EXPECT_EQ(*text, print_text(write_calibration(display))) << name;
  }
}

}  // namespace
}  // namespace lfd
