// Test patterns in the image's own pixels: each has a known answer, and every pixel must be it.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "calibration/make_color.h"
#include "tests/gl/pattern_pictures.h"

namespace lfd {
namespace {

using namespace testing_support;

// The digits as a person would draw them.
constexpr std::array<std::array<const char*, 5>, 10> kDigits{{{"###", "#.#", "#.#", "#.#", "###"},
                                                              {".#.", "##.", ".#.", ".#.", "###"},
                                                              {"###", "..#", "###", "#..", "###"},
                                                              {"###", "..#", "###", "..#", "###"},
                                                              {"#.#", "#.#", "###", "..#", "..#"},
                                                              {"###", "#..", "###", "..#", "###"},
                                                              {"###", "#..", "###", "#.#", "###"},
                                                              {"###", "..#", "..#", "..#", "..#"},
                                                              {"###", "#.#", "###", "#.#", "###"},
                                                              {"###", "#.#", "###", "..#", "###"}}};

// A picture of '#' and '.', whose rows are given.
FedPicture drawn_by_hand(const std::vector<std::string>& rows) {
  const ImageSize size{static_cast<int>(rows.front().size()), static_cast<int>(rows.size())};
  return picture_of(size, [&](PixelIndex i) {
    return rows[static_cast<std::size_t>(i.row)][static_cast<std::size_t>(i.column)] == '#' ? kWhite : kBlack;
  });
}

// The number's squares, each `side` pixels large, put into the middle of a frame with a filled corner.
FedPicture number_picture(int number, ImageSize size, int side, int corner) {
  std::vector<std::string> rows(static_cast<std::size_t>(size.height),
                                std::string(static_cast<std::size_t>(size.width), '.'));
  const auto set = [&](int column, int row) {
    rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = '#';
  };
  for (int column = 0; column < size.width; ++column) set(column, 0), set(column, size.height - 1);
  for (int row = 0; row < size.height; ++row) set(0, row), set(size.width - 1, row);
  for (int row = 0; row <= corner; ++row) {
    for (int column = 0; column + row <= corner; ++column) set(column, row);
  }
  const std::string digits = std::to_string(number);
  const int wide = side * (4 * static_cast<int>(digits.size()) - 1);
  const int left = (size.width - wide) / 2, top = (size.height - 5 * side) / 2;
  for (std::size_t d = 0; d < digits.size(); ++d) {
    for (int row = 0; row < 5 * side; ++row) {
      for (int column = 0; column < 3 * side; ++column) {
        if (kDigits[static_cast<std::size_t>(digits[d] - '0')][static_cast<std::size_t>(row / side)][column / side] ==
            '#')
          set(left + 4 * side * static_cast<int>(d) + column, top + row);
      }
    }
  }
  return drawn_by_hand(rows);
}

TEST(NumberPattern, IsThisPicture) {
  const auto frame = drawn_pattern(row_of_modules(18, {24, 20}), pattern_of(proto::TestPattern::NUMBER));
  EXPECT_TRUE(is_picture(fed_picture(frame, 17), drawn_by_hand({"########################",  //
                                                                "###....................#",  //
                                                                "##.....................#",  //
                                                                "#......................#",  //
                                                                "#......................#",  //
                                                                "#......##....######....#",  //
                                                                "#......##....######....#",  //
                                                                "#....####........##....#",  //
                                                                "#....####........##....#",  //
                                                                "#......##........##....#",  //
                                                                "#......##........##....#",  //
                                                                "#......##........##....#",  //
                                                                "#......##........##....#",  //
                                                                "#....######......##....#",  //
                                                                "#....######......##....#",  //
                                                                "#......................#",  //
                                                                "#......................#",  //
                                                                "#......................#",  //
                                                                "#......................#",  //
                                                                "########################"})));
}

FedPicture flipped(const FedPicture& picture, bool columns, bool rows) {
  const ImageSize size = picture.size;
  return picture_of(size, [&](PixelIndex i) {
    return picture.at({columns ? size.width - 1 - i.column : i.column, rows ? size.height - 1 - i.row : i.row});
  });
}

// Of all modules of the largest published display and two more, at 64 x 48 pixels.
TEST(NumberPattern, TellsAllModulesApartHoweverTheyAreFlippedOrTurned) {
  const ImageSize size{64, 48};
  const auto frame = drawn_pattern(row_of_modules(130, size), pattern_of(proto::TestPattern::NUMBER));
  std::set<std::vector<Levels>> upright, others;
  for (int module = 0; module < 130; ++module) {
    const FedPicture picture = fed_picture(frame, static_cast<std::uint32_t>(module));
    ASSERT_TRUE(is_picture(picture, number_picture(module, size, module < 100 ? 5 : 4, 8))) << "module " << module;
    upright.insert(picture.pixels);
    for (const auto& [columns, rows] : {std::pair(true, false), {false, true}, {true, true}})
      others.insert(flipped(picture, columns, rows).pixels);
  }
  EXPECT_EQ(upright.size(), 130U);
  for (const auto& pixels : upright) EXPECT_FALSE(others.contains(pixels));
}

TEST(NumberPattern, IsTheModulesOwnWhereverItsNodeKeepsIt) {
  const DisplayCalibration display = row_of_modules(1024, {64, 48});
  Renderer renderer(context(), display, {1023, 5, 12});
  const auto frame = draw_pattern(renderer, settings_with(pattern_of(proto::TestPattern::NUMBER)));
  EXPECT_TRUE(is_picture(fed_picture(frame, 1023), number_picture(1023, {64, 48}, 3, 8)));
  EXPECT_TRUE(is_picture(fed_picture(frame, 5), number_picture(5, {64, 48}, 5, 8)));
  EXPECT_TRUE(is_picture(fed_picture(frame, 12), number_picture(12, {64, 48}, 5, 8)));
}

TEST(NumberPattern, FitsIntoSmallImagesAndFillsLargeOnes) {
  for (const auto& [size, side, corner] :
       {std::tuple(ImageSize{16, 8}, 1, 3), {ImageSize{8, 7}, 1, 3}, {ImageSize{640, 400}, 48, 66}}) {
    const auto frame = drawn_pattern(row_of_modules(5, size), pattern_of(proto::TestPattern::NUMBER));
    EXPECT_TRUE(is_picture(fed_picture(frame, 4), number_picture(4, size, side, corner))) << size.width;
  }
}

TEST(GridPattern, HasLinesOnTheseVeryPixels) {
  for (const auto& [size, spacing] :
       {std::pair(ImageSize{65, 48}, 16), {ImageSize{64, 47}, 7}, {ImageSize{50, 40}, 0}}) {
    proto::TestPattern pattern = pattern_of(proto::TestPattern::GRID);
    pattern.set_spacing_px(spacing);
    pattern.mutable_color()->set_g(1);
    const auto expected = picture_of(size, [&](PixelIndex i) -> Levels {
      const int every = spacing == 0 ? 32 : spacing;
      const bool on_frame = i.column == 0 || i.row == 0 || i.column == size.width - 1 || i.row == size.height - 1;
      const bool in_middle = i.column == size.width / 2 || i.column == (size.width - 1) / 2 ||
                             i.row == size.height / 2 || i.row == (size.height - 1) / 2;
      const bool on_line = i.column % every == 0 || i.row % every == 0;
      return on_frame ? Levels{0, 255, 0} : in_middle ? kRed : on_line ? Levels{0, 255, 0} : kBlack;
    });
    const auto frame = drawn_pattern(row_of_modules(2, size), pattern);
    for (const std::uint32_t module : {0U, 1U}) EXPECT_TRUE(is_picture(fed_picture(frame, module), expected));
  }
}

TEST(CheckerPattern, HasSquaresFromTheTopLeft) {
  proto::TestPattern pattern = pattern_of(proto::TestPattern::CHECKER);
  pattern.set_spacing_px(5);
  const auto expected =
      picture_of({64, 48}, [](PixelIndex i) { return (i.column / 5) % 2 == (i.row / 5) % 2 ? kWhite : kBlack; });
  EXPECT_TRUE(is_picture(fed_picture(drawn_pattern(row_of_modules(1, {64, 48}), pattern), 0), expected));
}

// All 256 bytes of all channels, whatever the transfer function of the target; also where a module has a colour
// calibration, which would change them.
TEST(SolidPattern, FeedsModulesTheseVeryBytes) {
  const DisplayCalibration plain = row_of_modules(2, {4, 3});
  const DisplayCalibration corrected = colored(plain, 5);
  Renderer renderer(context(), plain, {0, 1}), with_color(context(), corrected, {0, 1});
  for (int byte = 0; byte < 256; ++byte) {
    const Levels levels{byte, 255 - byte, 7 * byte % 256};
    proto::TestPattern pattern = pattern_of(proto::TestPattern::SOLID);
    pattern.mutable_color()->set_r(levels[0] / 255.0);
    pattern.mutable_color()->set_g(levels[1] / 255.0);
    pattern.mutable_color()->set_b(levels[2] / 255.0);
    const auto expected = picture_of({4, 3}, [&](PixelIndex) { return levels; });
    for (Renderer* one : {&renderer, &with_color}) {
      const auto frame = draw_pattern(*one, settings_with(pattern));
      ASSERT_TRUE(is_picture(fed_picture(frame, 1), expected)) << byte;
    }
  }
}

TEST(SolidPattern, IsWhiteUnlessSaidOtherwise) {
  const auto frame = drawn_pattern(row_of_modules(1, {4, 3}), pattern_of(proto::TestPattern::SOLID));
  EXPECT_TRUE(is_picture(fed_picture(frame, 0), picture_of({4, 3}, [](PixelIndex) { return kWhite; })));
}

TEST(EveryPattern, IsBlackOnModulesThatDoNotShowIt) {
  const DisplayCalibration display = row_of_modules(6, {32, 24});
  const auto black = picture_of({32, 24}, [](PixelIndex) { return kBlack; });
  for (const auto kind :
       {proto::TestPattern::NUMBER, proto::TestPattern::GRID, proto::TestPattern::CHECKER, proto::TestPattern::SOLID}) {
    proto::TestPattern pattern = pattern_of(kind);
    const auto all = drawn_pattern(display, pattern);
    pattern.add_modules("1");
    pattern.add_modules("3-4");
    const auto some = drawn_pattern(display, pattern);
    for (std::uint32_t module = 0; module < 6; ++module) {
      const bool shows = module == 1 || module == 3 || module == 4;
      EXPECT_TRUE(is_picture(fed_picture(some, module), shows ? fed_picture(all, module) : black)) << module;
      EXPECT_FALSE(is_picture(fed_picture(all, module), black)) << module;
    }
  }
}

}  // namespace
}  // namespace lfd
