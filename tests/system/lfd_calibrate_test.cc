// lfd-calibrate as a person or a partner process uses it: answers, exit codes and messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "base/process.h"
#include "calibration/display.h"
#include "proto/calibration_file.h"
#include "tests/harness/workbench.h"

namespace lfd {
namespace {

using testing::HasSubstr;

struct Answer {
  int exit_code = -1;
  std::string text;  // standard output and standard error
};

// Runs the program through the shell, `input` on its standard input.
Answer calibrate(const std::string& arguments, const std::string& input = "") {
  const std::string command = "printf '" + input + "' | " + LFD_BIN_DIR + "/lfd-calibrate " + arguments + " 2>&1";
  Answer answer;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return answer;
  std::array<char, 4096> buffer;
  for (std::size_t got = 0; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    answer.text.append(buffer.data(), got);
  const int status = pclose(pipe);
  if (WIFEXITED(status)) answer.exit_code = WEXITSTATUS(status);
  return answer;
}

const std::string kDesk = std::string(LFD_SOURCE_DIR) + "/configs/displays/desk.textproto";

TEST(LfdCalibrate, MapsPointsLineByLine) {
  // On the screen the optics move nothing, and the ideal map fills 256 x 192 px with 0.4 x 0.3 m.
  const Answer answer = calibrate("map " + kDesk + " --module 3", "0 0 0\\n0 0 0.9\\nnan 0 0\\n");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(answer.text, "128 96 0\nnone\nnone\n");
}

// Seventeen digits are those of which the same double is made again.
TEST(LfdCalibrate, AnswersAreTheMapsOwnDoubles) {
  const auto display = load_calibration(kDesk);
  ASSERT_TRUE(display);
  double u = 0, v = 0, z = 0;
  const Answer map = calibrate("map " + kDesk + " --module 0", "0.1 0.02 0.0625\n");
  ASSERT_EQ(std::sscanf(map.text.c_str(), "%lf %lf %lf", &u, &v, &z), 3) << map.text;
  const auto image = image_from_physical(*display, display->modules[0], {0.1, 0.02, 0.0625});
  ASSERT_TRUE(image);
  EXPECT_EQ(u, image->u);
  EXPECT_EQ(v, image->v);
  EXPECT_EQ(z, image->z);
  double sx = 0, sy = 0, sz = 0, ox = 0, oy = 0, oz = 0;
  const Answer ray = calibrate("ray " + kDesk + " --module 0", "17.3 101.7\n");
  ASSERT_EQ(std::sscanf(ray.text.c_str(), "%lf %lf %lf %lf %lf %lf", &sx, &sy, &sz, &ox, &oy, &oz), 6) << ray.text;
  const auto line = pixel_line(*display, display->modules[0], {17.3, 101.7});
  ASSERT_TRUE(line);
  EXPECT_EQ(sx, line->on_screen.x);
  EXPECT_EQ(sy, line->on_screen.y);
  EXPECT_EQ(ox, line->on_observer_line.x);
  EXPECT_EQ(oz, line->on_observer_line.z);
}

// A partner that waits for each answer before it asks again gets it.
TEST(LfdCalibrate, AnswersALineBeforeTheNextOneComes) {
  const harness::Workbench bench;
  const std::string in = bench.folder() / "in", out = bench.folder() / "out";
  const std::string script = "mkfifo " + in + "; " + LFD_BIN_DIR + "/lfd-calibrate map " + kDesk + " --module 3 <" +
                             in + " >" + out + " & exec 3>" + in + "; echo 0 0 0 >&3; " +
                             "for i in $(seq 200); do [ -s " + out + " ] && break; sleep 0.05; done; cat " + out +
                             "; exec 3>&-; wait";
  const auto shell =
      Process::start({.name = "sh", .command = {"/bin/sh", "-c", script}, .on_line = {}, .environment = {}});
  ASSERT_TRUE(shell);
  EXPECT_TRUE((*shell)->wait(std::chrono::seconds(30)));
  EXPECT_THAT((*shell)->lines(), testing::ElementsAre("128 96 0"));
}

TEST(LfdCalibrate, PrintsThePixelsLine) {
  const Answer answer = calibrate("ray " + kDesk + " --module 0", "128 96\\n-1 5\\n");
  EXPECT_EQ(answer.exit_code, 0);
  double sx = 1, sy = 1, sz = 1, ox = 0, oy = 1, oz = 0;
  ASSERT_EQ(std::sscanf(answer.text.c_str(), "%lf %lf %lf %lf %lf %lf", &sx, &sy, &sz, &ox, &oy, &oz), 6)
      << answer.text;
  EXPECT_EQ(sx, 0);
  EXPECT_EQ(sy, 0);
  EXPECT_EQ(sz, 0);
  EXPECT_NEAR(ox, 0.8 * 0.36397023426620234, 1e-12);  // vz tan 20 degrees: opposite the leftmost emitter
  EXPECT_EQ(oy, 0);
  EXPECT_EQ(oz, 0.8);
  EXPECT_THAT(answer.text, HasSubstr("\nnone\n"));
}

TEST(LfdCalibrate, NamesTheMalformedLine) {
  const Answer answer = calibrate("map " + kDesk + " --module 3", "0 0 0\\n1 2\\n0 0 0\\n");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.text, HasSubstr("128 96 0\n"));
  EXPECT_THAT(answer.text, HasSubstr("standard input:2: "));
}

TEST(LfdCalibrate, WrongUseSaysWhatWasMeant) {
  EXPECT_EQ(calibrate("").exit_code, 2);
  EXPECT_EQ(calibrate("--help").exit_code, 0);
  EXPECT_EQ(calibrate("map " + kDesk + " --module 8").exit_code, 2);
  const Answer command = calibrate("chek x"), option = calibrate("make desk --perturbe 1"),
               name = calibrate("make dsk");
  EXPECT_EQ(command.exit_code, 2);
  EXPECT_THAT(command.text, HasSubstr("did you mean check?"));
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.text, HasSubstr("did you mean --perturb?"));
  EXPECT_EQ(name.exit_code, 2);
  EXPECT_THAT(name.text, HasSubstr("did you mean desk?"));
}

TEST(LfdCalibrate, MakesColoursAndTellsOfThem) {
  EXPECT_THAT(calibrate("info " + kDesk).text, HasSubstr("sRGB"));
  const std::string file = testing::TempDir() + "lfd-calibrate-color.textproto";
  EXPECT_EQ(calibrate("make desk --color 3 --out " + file).exit_code, 0);
  const Answer info = calibrate("info " + file);
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_THAT(info.text, HasSubstr("8 of 8 modules corrected: gain 0."));
  EXPECT_THAT(info.text, HasSubstr(", gamma 2."));
  std::remove(file.c_str());
}

TEST(LfdCalibrate, MakesMeasuredAndCurvedDisplaysThatPassTheCheck) {
  const std::string file = testing::TempDir() + "lfd-calibrate-made-" + std::to_string(getpid()) + ".textproto";
  for (const std::string wishes : {"--grid 33x25 --warp 1.5", "--perturb 3 --radius=-5 --observer-arc",
                                   "--perturb 3 --radius 3 --grid 25x19 --color 2"}) {
    EXPECT_EQ(calibrate("make desk " + wishes + " --out " + file).exit_code, 0) << wishes;
    const Answer check = calibrate("check " + file);
    EXPECT_EQ(check.exit_code, 0) << wishes << "\n" << check.text;
    const Answer info = calibrate("info " + file);
    const bool is_grid = wishes.find("--grid") != std::string::npos,
               is_curved = wishes.find("radius") != std::string::npos;
    EXPECT_EQ(info.text.find("grid") != std::string::npos, is_grid) << info.text;
    EXPECT_EQ(info.text.find("cylinder") != std::string::npos, is_curved) << info.text;
  }
  // The arc is so narrow that wide rays miss it.
  EXPECT_EQ(calibrate("make desk --radius=-1.5 --observer-arc --out " + file).exit_code, 0);
  EXPECT_THAT(calibrate("check " + file).text, HasSubstr("missed: coverage"));
  std::remove(file.c_str());
  for (const char* wrong :
       {"--grid 33", "--grid 1x5", "--warp 2", "--observer-arc", "--radius 0", "--radius nan", "--grids pfm"})
    EXPECT_EQ(calibrate("make desk " + std::string(wrong)).exit_code, 2) << wrong;
  EXPECT_THAT(calibrate("make c80-conical --radius 2").text, HasSubstr("CONICAL on a curved screen"));
}

TEST(LfdCalibrate, ChecksAndRefuses) {
  EXPECT_EQ(calibrate("check " + kDesk).exit_code, 0);
  const Answer strict = calibrate("check " + kDesk + " --min-coverage 1.5");
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_THAT(strict.text, HasSubstr("missed: coverage"));
  EXPECT_THAT(strict.text, HasSubstr("verdict               refused"));
  EXPECT_EQ(calibrate("check " + kDesk + " --max-condition 1.01").exit_code, 1);
  EXPECT_EQ(calibrate("check " + kDesk + " --max-round-trip-px 1e-20 --max-condition 1").exit_code, 1);
  EXPECT_EQ(calibrate("check " + kDesk + " --max-mirrored nonsense").exit_code, 2);
  EXPECT_EQ(calibrate("check " + kDesk + " --plot x --module 8").exit_code, 2);
  EXPECT_EQ(calibrate("check /no/such/file").exit_code, 1);
}

TEST(LfdCalibrate, ExportsAndImportsMpcdi) {
  const std::string folder = testing::TempDir() + "lfd-calibrate-mpcdi-" + std::to_string(getpid());
  std::filesystem::create_directory(folder);
  const std::string archive = folder + "/desk.mpcdi", copy = folder + "/copy.textproto";
  EXPECT_EQ(calibrate("export " + kDesk + " --out " + archive + " --size 64 48").exit_code, 0);
  const Answer import = calibrate("import " + archive + " --nodes 33 --grids pfm --out " + copy);
  EXPECT_EQ(import.exit_code, 0) << import.text;
  EXPECT_THAT(import.text, HasSubstr("warning: warps of 64 x 48 points were thinned to 33 x 33 (in 8 of 8 regions)"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/copy-module-007.pfm"));
  double u = 0, v = 0;
  const Answer answer = calibrate("map " + copy + " --module 3", "0 0 0\\n");
  ASSERT_EQ(std::sscanf(answer.text.c_str(), "%lf %lf", &u, &v), 2) << answer.text;
  EXPECT_NEAR(u, 128, 1e-4);  // float32 of 0.2 m, at 640 px a metre
  EXPECT_NEAR(v, 96, 1e-4);
  EXPECT_EQ(calibrate("export " + kDesk + " --out " + folder + "/desk.zip").exit_code, 2);
  EXPECT_EQ(calibrate("import " + archive + " --grids csv").exit_code, 2);
  std::filesystem::remove_all(folder);
}

TEST(LfdCalibrate, NamesEveryMissedLimitOnALineOfItsOwn) {
  const Answer answer = calibrate("check " + kDesk + " --min-coverage 1.5 --max-condition 1");
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.text, HasSubstr("\nmissed: condition number: "));
  EXPECT_THAT(answer.text, HasSubstr("\nmissed: coverage: 1 of the screen (module 0); at least 1.5 is accepted\n"));
}

TEST(LfdCalibrate, LimitsGapsDepthAndHoles) {
  EXPECT_EQ(calibrate("check " + kDesk).exit_code, 0);
  const Answer gap = calibrate("check " + kDesk + " --max-gap 0.5");
  EXPECT_EQ(gap.exit_code, 1);
  EXPECT_THAT(gap.text, HasSubstr("missed: angle between neighbouring emitters: "));
  const Answer depth = calibrate("check " + kDesk + " --min-depth 10");
  EXPECT_EQ(depth.exit_code, 1);
  EXPECT_THAT(depth.text, HasSubstr("missed: depth: the spot has doubled "));
  EXPECT_EQ(calibrate("check " + kDesk + " --max-holes -1").exit_code, 2);
  // Whatever is compared with it would be accepted.
  for (const char* option : {"--max-holes", "--min-coverage", "--min-depth", "--depth"})
    EXPECT_EQ(calibrate("check " + kDesk + " " + option + " nan").exit_code, 2) << option;
}

TEST(LfdCalibrate, TakesTheConditionInTheRegionOfInterest) {
  EXPECT_THAT(calibrate("check " + kDesk + " --roi 0,0,0,0.4,0.3,0.1").text, HasSubstr(", in the region of interest"));
  const auto json = nlohmann::json::parse(calibrate("check " + kDesk + " --json --roi=-0.1,0,0,0.4,0.3,0.1").text);
  EXPECT_EQ(json["roi"]["physical_centre"][0], -0.1);
  EXPECT_EQ(json["roi"]["physical_size"][2], 0.1);
  EXPECT_TRUE(json["half_depth_m"].is_null());
  EXPECT_EQ(calibrate("check " + kDesk + " --roi 0,0,0,0.4,0.3,0").exit_code, 2);
  EXPECT_EQ(calibrate("check " + kDesk + " --roi 0,0,0,nan,1,1").exit_code, 2);
  EXPECT_EQ(calibrate("check " + kDesk + " --roi 0,0,0,1 --depth 1").exit_code, 2);
}

TEST(LfdCalibrate, TellsProgramsEverythingAsJson) {
  const Answer answer = calibrate("check " + kDesk + " --json --min-coverage 1.5 2>/dev/null; exit $?");
  EXPECT_EQ(answer.exit_code, 1);
  const auto json = nlohmann::json::parse(answer.text, nullptr, false);
  ASSERT_TRUE(json.is_object()) << answer.text;
  for (const char* const key : {"version", "display", "accepted", "missed", "limits", "half_depth_m", "all",
                                "worst_module", "coverage_any", "pixel_width_m", "angles", "depth", "modules"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["accepted"], false);
  EXPECT_EQ(json["missed"].size(), 1u);
  EXPECT_EQ(json["modules"].size(), 8u);
  for (const char* const key : {"round_trip_median_px", "round_trip_999_px", "round_trip_max_px", "image_on_screen",
                                "image_unmapped", "mirrored", "near_singular", "folded", "incomplete",
                                "condition_median", "condition_99", "condition_max", "coverage"}) {
    EXPECT_TRUE(json["all"].contains(key) && json["modules"][7].contains(key)) << key;
  }
  EXPECT_EQ(json["all"]["coverage"], 1.0);
  EXPECT_EQ(json["angles"]["order"], "left_to_right");
  EXPECT_LT(json["angles"]["gap_over_scattering"], 0.7);
  for (const char* const key : {"incomplete", "gap_over_scattering", "depth_least_m"}) {
    EXPECT_TRUE(json["limits"].contains(key)) << key;
  }
  EXPECT_EQ(json["depth"]["spots"][0]["distance_m"], 0.0);
}

TEST(LfdCalibrate, WritesPicturesOfTheCheck) {
  const harness::Workbench bench;
  const std::string folder = (bench.folder() / "plots").string();
  EXPECT_EQ(calibrate("check " + kDesk + " --plot " + folder + " --module 3").exit_code, 0);
  for (const char* const file : {"overview.svg", "coverage.svg", "warp-module-003.svg", "condition-module-003.svg",
                                 "round-trip-module-003.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(bench.folder() / "plots" / file)) << file;
  }
}

TEST(LfdCalibrate, FailsWhereItsOutputCannotBeWritten) {
  EXPECT_EQ(calibrate("info " + kDesk + " >/dev/full").exit_code, 1);
  EXPECT_THAT(calibrate("make desk --out no/such/folder/desk.textproto").text, HasSubstr("there is no folder"));
}

}  // namespace
}  // namespace lfd
