// Grid files: what is written is read again, known bytes have known nodes, and bad files say where they are bad.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <string>

#include "base/file.h"
#include "base/log.h"
#include "calibration/import/pfm.h"
#include "proto/calibration_file.h"
#include "proto/grid_csv.h"
#include "proto/grid_files.h"
#include "proto/pictures/exr.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kHole = std::numeric_limits<double>::quiet_NaN();

// 3 x 2 nodes of which no two agree, with one hole; the numbers are exact in float32.
GridNodes asymmetric_nodes() {
  GridNodes nodes;
  nodes.columns = 3;
  nodes.rows = 2;
  nodes.node = {{-1, 0.5}, {0.25, 0.625}, {1.5, 0.75}, {-1.125, -0.5}, {kHole, kHole}, {1.375, -0.25}};
  return nodes;
}

// The bytes of a float, the most significant first.
std::string high_byte_first(float number) {
  const auto word = std::bit_cast<std::uint32_t>(number);
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>((word >> shift) & 0xff));
  return bytes;
}

std::string low_byte_first(float number) {
  std::string bytes = high_byte_first(number);
  return {bytes.rbegin(), bytes.rend()};
}

std::string error_of(std::string_view name, std::string_view content) {
  const auto nodes = parse_grid_file(name, content);
  return nodes ? "" : nodes.error().message();
}

// A folder of this test alone, removed with it.
class GridFolder : public testing::Test {
 protected:
  GridFolder() { std::filesystem::create_directories(folder_); }
  ~GridFolder() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, std::string_view content) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    const auto status = write_file(folder_ / name, content);
    ASSERT_TRUE(status) << status.error().message();
  }
  // The calibration of a display of one module with this grid.
  Result<DisplayCalibration> load(const std::string& grid) {
    write("wall.textproto",
          "screen { width_m: 4 height_m: 2 } image { width_px: 30 height_px: 20 }\n"
          "optics { diffuser: LINEAR observer_distance_m: 3 } angular_scattering_rad: 0.1\n"
          "module {\n  emitter { z: -1 }\n  grid {\n    " +
              grid + "\n  }\n}\n");
    return load_calibration(folder_ / "wall.textproto");
  }
  std::string error_of_grid(const std::string& grid) {
    const auto display = load(grid);
    if (display) return "";
    const std::string message = display.error().message();
    return message.substr(message.find("wall.textproto"));
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      fmt::format("lfd-{}-{}", testing::UnitTest::GetInstance()->current_test_info()->name(), ::getpid());
};

TEST(GridFiles, CsvKeepsEveryDouble) {
  GridNodes nodes = asymmetric_nodes();
  nodes.node[2] = {1.0 / 3, std::nextafter(0.1, 1.0)};
  const auto read = parse_grid_file("g.csv", print_grid_csv(nodes));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(*read, nodes);
}

TEST(GridFiles, CsvLinesComeInAnyOrderWithBlanksAndDosLineEnds) {
  const auto read = parse_grid_csv("column,row,s,y\r\n1, 1, 1.375, -0.25\r\n\r\n 0,0,-1,5e-1\r\n");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->columns, 2);
  EXPECT_EQ(read->rows, 2);
  EXPECT_EQ(read->at(0, 0), (ScreenPoint{-1, 0.5}));
  EXPECT_EQ(read->at(1, 1), (ScreenPoint{1.375, -0.25}));
  EXPECT_TRUE(std::isnan(read->at(1, 0).x) && std::isnan(read->at(1, 0).y));
}

TEST(GridFiles, BadCsvNamesTheLine) {
  const std::string header = "column,row,s,y\n0,0,1,2\n";
  struct Case {
    std::string text, error;
  };
  for (const Case& c : {
           Case{"", "no nodes"},
           Case{"column,row,y,s\n", "1: the first line must be"},
           Case{"column,row,s,y\n", "no nodes"},
           Case{header + "1,0,1\n", "3: four fields"},
           Case{header + "1,0,1,2,3\n", "3: four fields"},
           Case{header + "\n-1,0,1,2\n", "4: column: \"-1\""},
           Case{header + "4096,0,1,2\n", "3: column: \"4096\""},
           Case{header + "1,99999999999,1,2\n", "3: row: "},
           Case{header + "1,0.5,1,2\n", "3: row: \"0.5\""},
           Case{header + "1,0,wide,2\n", "3: s: \"wide\""},
           Case{header + "1,0,inf,2\n", "3: s: \"inf\""},
           Case{header + "1,0,1,nan\n", "3: y: \"nan\""},
           Case{header + "1,0,1,2\n0,0,3,4\n", "4: column 0, row 0 is given twice"},
           Case{header + "4095,4095,1,2\n", "2 lines for 4096 x 4096 nodes"},
       }) {
    EXPECT_THAT(error_of("g.csv", c.text), StartsWith(c.error)) << c.text;
  }
}

TEST(GridFiles, PfmRowsRunFromTheBottomInBothByteOrders) {
  // Two columns, two rows: the file begins with the lower row.
  const float bottom[] = {1, 2, 9, 3, 4, 9}, top[] = {5, 6, 9, 7, 8, 9};
  for (const bool low : {false, true}) {
    std::string file = fmt::format("PF\n2 2\n{}1.0\n", low ? "-" : "");
    for (const float number : bottom) file += low ? low_byte_first(number) : high_byte_first(number);
    for (const float number : top) file += low ? low_byte_first(number) : high_byte_first(number);
    const auto read = parse_grid_file("g.pfm", file);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->at(0, 0), (ScreenPoint{5, 6}));
    EXPECT_EQ(read->at(1, 0), (ScreenPoint{7, 8}));
    EXPECT_EQ(read->at(0, 1), (ScreenPoint{1, 2}));
    EXPECT_EQ(read->at(1, 1), (ScreenPoint{3, 4}));
  }
}

TEST(GridFiles, PfmScaleMultipliesAndNanIsAHole) {
  std::string file = "PF 2 1 -0.001\n";
  for (const float number : {250.0F, -500.0F, 0.0F, std::nanf(""), 1.0F, 0.0F}) file += low_byte_first(number);
  const auto read = parse_grid_file("g.pfm", file);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->at(0, 0), (ScreenPoint{0.25F, -0.5F}));
  EXPECT_TRUE(std::isnan(read->at(1, 0).x) && std::isnan(read->at(1, 0).y));
}

TEST(GridFiles, PfmKeepsEveryFloat) {
  PfmPixels pixels{2, 1, {1.0F / 3, -0.0F, std::numeric_limits<float>::infinity(), 1e-45F, 3e38F, -7}};
  const auto read = parse_pfm(print_pfm(pixels), 2);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->numbers, pixels.numbers);
  EXPECT_TRUE(std::signbit(read->numbers[1]));
}

TEST(GridFiles, BadPfmSaysWhatIsWrong) {
  struct Case {
    std::string text, error;
  };
  for (const Case& c : {
           Case{"", "PFM: does not begin with PF"},
           Case{"P6\n1 1\n255\n", "PFM: does not begin with PF"},
           Case{"Pf\n1 1\n-1\n", "PFM: one channel (Pf)"},
           Case{"PF", "PFM: width: a number is needed"},
           Case{"PF\n1", "PFM: height: a number is needed"},
           Case{"PF\n1.5 1\n", "PFM: width: a number is needed"},
           Case{"PF\n1000000000 1000000000\n-1\n", "PFM: width: 1000000000; 1 to 4096"},
           Case{"PF\n99999999999999999999 1\n-1\n", "PFM: width: a number is needed"},
           Case{"PF\n2 0\n-1\n", "PFM: height: 0;"},
           Case{"PF\n2 2\nnan\n", "PFM: scale: nan"},
           Case{"PF\n2 2\n0\n", "PFM: scale: 0"},
           Case{"PF\n2 2\n-1", "PFM: ends after the header"},
           Case{"PF\n4096 4096\n-1\n1234", "PFM: 4 bytes of pixels; 4096 x 4096 pixels need 201326592"},
           Case{"PF\n1 1\n-1\n0123456789abc", "PFM: 13 bytes of pixels"},
       }) {
    EXPECT_THAT(error_of("g.pfm", c.text), StartsWith(c.error)) << c.text;
  }
  EXPECT_THAT(error_of("g.png", ""), HasSubstr(".pfm, .exr or .csv"));
}

TEST(GridFiles, ChangedBytesNeverCrash) {
  PfmPixels pixels{3, 2, std::vector<float>(18, 0.5F)};
  const std::string files[] = {print_pfm(pixels), print_grid_csv(asymmetric_nodes()),
                               *encode_exr({2, 2, std::vector<float>(16, 0.5F)})};
  const char* const names[] = {"g.pfm", "g.csv", "g.exr"};
  std::mt19937 random(1);
  for (int round = 0; round < 20000; ++round) {
    std::string file = files[round % 3];
    for (auto changes = random() % 4; changes > 0; --changes)
      file[random() % file.size()] = static_cast<char>(random());
    if (random() % 4 == 0) file.resize(random() % file.size());
    const auto nodes = parse_grid_file(names[round % 3], file);
    if (!nodes) continue;
    EXPECT_EQ(nodes->node.size(), static_cast<std::size_t>(nodes->columns) * static_cast<std::size_t>(nodes->rows));
  }
}

TEST_F(GridFolder, GridsLieBesideTheCalibration) {
  const std::string place = "first_u_px: 1 first_v_px: 2 step_u_px: 10 step_v_px: 12";
  GridNodes nodes = asymmetric_nodes();
  nodes.node[4] = {0.125, -0.375};
  nodes.first_u_px = 1;
  nodes.first_v_px = 2;
  nodes.step_u_px = 10;
  nodes.step_v_px = 12;
  write("maps/left.csv", print_grid_csv(nodes));
  const auto display = load("file: \"maps/left.csv\" " + place);
  ASSERT_TRUE(display) << display.error().message();
  EXPECT_EQ(std::get<GridMap>(display->modules[0].map).nodes(), nodes);

  for (const auto format : {GridFileFormat::kPfm, GridFileFormat::kCsv}) {
    const auto status = save_calibration(folder_ / "copy.textproto", *display, format);
    ASSERT_TRUE(status) << status.error().message();
    const auto copy = load_calibration(folder_ / "copy.textproto");
    ASSERT_TRUE(copy) << copy.error().message();
    EXPECT_EQ(*copy, *display);  // the nodes are exact in float32
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "copy-module-000.pfm"));
}

TEST_F(GridFolder, ErrorsNameLineModuleAndFile) {
  write("good.csv", "column,row,s,y\n0,0,-1,1\n1,0,1,1\n0,1,-1,-1\n1,1,1,-1\n");
  write("bad.csv", "column,row,s,y\n0,0,-1,oops\n");
  const std::string steps = " step_u_px: 1 step_v_px: 1";
  EXPECT_EQ(error_of_grid("file: \"good.csv\"" + steps), "");
  const std::string road = "wall.textproto:6: module 0: grid: file: ";
  EXPECT_THAT(error_of_grid("file: \"bad.csv\"" + steps), StartsWith(road + "bad.csv: 2: y: \"oops\""));
  write("far.csv", "column,row,s,y\n0,0,-1,1\n1,0,1e30,1\n0,1,-1,-1\n1,1,1,-1\n");
  EXPECT_THAT(error_of_grid("file: \"far.csv\"" + steps), StartsWith(road + "far.csv: 3: s: 1e+30 m; at most"));
  write("same.csv", "column,row,s,y\n1,1,1,-1\n1,0,1,1\n0,1,-1,-1\n0,0,1,1\n");
  EXPECT_THAT(error_of_grid("file: \"same.csv\"" + steps), StartsWith(road + "same.csv: 5: s: at the same place"));
  write("half.pfm", print_pfm({2, 2, {-1, 1, 0, 1, 1, 0, -1, -1, 0, 1, -3e38F, 0}}));
  EXPECT_THAT(error_of_grid("file: \"half.pfm\"" + steps), StartsWith(road + "half.pfm: pixel (1, 1): y: -3e+38 m"));
  EXPECT_THAT(error_of_grid("file: \"none.csv\"" + steps), StartsWith(road + "none.csv: "));
  EXPECT_THAT(error_of_grid("file: \"/etc/hostname\"" + steps), HasSubstr("must be relative"));
  EXPECT_THAT(error_of_grid("file: \"a/../../good.csv\"" + steps), HasSubstr("leaves the calibration file's folder"));
  EXPECT_THAT(error_of_grid("file: \"good.csv\" columns: 3" + steps), HasSubstr("columns: 3, but the file has 2"));
  EXPECT_THAT(error_of_grid("file: \"good.csv\" s: 1 y: 1" + steps), HasSubstr("one of both"));
  EXPECT_THAT(error_of_grid("file: \"good.csv\""), HasSubstr("step_u_px"));
}

}  // namespace
}  // namespace lfd
