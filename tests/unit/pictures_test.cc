// Picture files: round trips, known pixels, and bytes that are no pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
// After cstdio, which it needs:
#include <jpeglib.h>

#include "base/file.h"
#include "proto/pictures/decode.h"
#include "proto/pictures/exr.h"
#include "proto/pictures/png.h"

namespace lfd {
namespace {

using testing::HasSubstr;

Picture8 noise(int width, int height, bool opaque) {
  std::mt19937 random(3);
  Picture8 picture = black_picture(width, height);
  for (auto& value : picture.rgba) value = static_cast<std::uint8_t>(random());
  for (std::size_t at = 3; opaque && at < picture.rgba.size(); at += 4) picture.rgba[at] = 255;
  return picture;
}

PictureF special_numbers() {
  using Limits = std::numeric_limits<float>;
  return {3,
          2,
          {0.0f,
           -0.0f,
           1.0f,
           1e-38f,
           Limits::max(),
           Limits::lowest(),
           Limits::denorm_min(),
           Limits::infinity(),
           -Limits::infinity(),
           0.1f,
           1e6f,
           1234.5678f,
           1,
           2,
           3,
           4,
           5,
           6,
           7,
           8,
           9,
           10,
           11,
           12}};
}

std::string jpeg_of(const Picture8& picture, int quality, bool progressive) {
  jpeg_compress_struct jpeg;
  jpeg_error_mgr errors;
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(picture.width);
  jpeg.image_height = static_cast<JDIMENSION>(picture.height);
  jpeg.input_components = 4;
  jpeg.in_color_space = JCS_EXT_RGBA;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  if (progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  for (int row = 0; row < picture.height; ++row) {
    auto* pixels = const_cast<JSAMPLE*>(picture.rgba.data() + std::size_t{4} * picture.width * row);
    jpeg_write_scanlines(&jpeg, &pixels, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::string file(reinterpret_cast<char*>(bytes), size);
  jpeg_destroy_compress(&jpeg);
  std::free(bytes);
  return file;
}

// Cuts `file` short everywhere and flips bytes of it at random: decoding must end, well or in an error, never in a
// crash.
template <class Decode>
void torture(const std::string& file, Decode decode) {
  for (std::size_t size = 0; size < file.size(); size += 1 + file.size() / 300) decode(file.substr(0, size));
  std::mt19937 random(5);
  for (int i = 0; i < 500; ++i) {
    std::string mutated = file;
    for (int flips = 1 + i % 4; flips > 0; --flips) mutated[random() % mutated.size()] = static_cast<char>(random());
    decode(mutated);
  }
}

TEST(Pictures, PngKeepsEveryByte) {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{7, 3}, std::pair{64, 48}}) {
    const Picture8 picture = noise(width, height, false);
    const auto file = encode_png(picture);
    ASSERT_TRUE(file);
    const auto back = decode_picture(*file);
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_EQ(*back, picture);
  }
}

TEST(Pictures, PngWithoutAlphaReadsBackOpaque) {
  const Picture8 picture = noise(9, 5, true);
  EXPECT_EQ(*decode_png(*encode_png(picture, PngChannels::kRgb)), picture);
}

TEST(Pictures, EveryCutPngIsAnErrorExceptWithoutItsEnd) {
  const std::string file = *encode_png(noise(16, 16, false));
  for (std::size_t size = 0; size + 12 < file.size(); ++size) {  // 12: the closing chunk
    EXPECT_FALSE(decode_picture(std::string_view(file).substr(0, size))) << size;
  }
}

TEST(Pictures, DamagedFilesNeverCrash) {
  const Picture8 picture = noise(24, 18, true);
  const auto decode = [](const std::string& file) { (void)static_cast<bool>(decode_picture(file)); };
  torture(*encode_png(picture), decode);
  torture(jpeg_of(picture, 80, false), decode);
  torture(jpeg_of(picture, 80, true), decode);
  torture(*encode_exr(special_numbers()), [](const std::string& file) { (void)static_cast<bool>(decode_exr(file)); });
}

TEST(Pictures, JpegKeepsAConstantColour) {
  Picture8 picture = black_picture(33, 17);
  for (std::size_t at = 0; at < picture.rgba.size(); at += 4) {
    picture.rgba[at] = 200, picture.rgba[at + 1] = 100, picture.rgba[at + 2] = 50, picture.rgba[at + 3] = 255;
  }
  for (const bool progressive : {false, true}) {
    const auto back = decode_picture(jpeg_of(picture, 95, progressive));
    ASSERT_TRUE(back) << back.error().message();
    ASSERT_EQ(back->rgba.size(), picture.rgba.size());
    // 3: rounding to YCbCr of 8 bits and quantisation at quality 95.
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) ASSERT_NEAR(back->rgba[i], picture.rgba[i], 3);
  }
}

TEST(Pictures, CutJpegIsAnErrorNotAGrayPicture) {
  const std::string file = jpeg_of(noise(64, 64, true), 80, false);
  EXPECT_FALSE(decode_picture(file.substr(0, file.size() / 2)));
}

TEST(Pictures, OtherBytesAreRefusedByName) {
  EXPECT_THAT(decode_picture("GIF89a").error().message(), HasSubstr("neither PNG nor JPEG"));
  EXPECT_THAT(decode_picture("").error().message(), HasSubstr("neither PNG nor JPEG"));
}

TEST(Pictures, AbsurdSizesAreRefusedBeforeTheirMemoryIsAsked) {
  std::string file = jpeg_of(noise(8, 8, true), 80, false);
  const auto frame_header = file.find("\xff\xc0");
  ASSERT_NE(frame_header, std::string::npos);
  file.replace(frame_header + 5, 4, "\xff\xdc\xff\xdc");  // height and width: 65500
  EXPECT_THAT(decode_picture(file).error().message(), HasSubstr("65500 x 65500 pixels; at most 67108864 are read"));
}

TEST(Pictures, ExrKeepsEveryFloat) {
  const PictureF picture = special_numbers();
  const auto file = encode_exr(picture);
  ASSERT_TRUE(file);
  const auto back = decode_exr(*file);
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(*back, picture);
  PictureF nan = picture;
  nan.rgba[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(decode_exr(*encode_exr(nan))->rgba[5]));
}

TEST(Pictures, ExrOfManyBlocksKeepsItsRowsFromTheTop) {
  PictureF picture{50, 70, std::vector<float>(50 * 70 * 4)};
  for (std::size_t i = 0; i < picture.rgba.size(); ++i) picture.rgba[i] = 0.25f * static_cast<float>(i);
  EXPECT_EQ(*decode_exr(*encode_exr(picture)), picture);
}

TEST(Pictures, FilesOnDiskComeBackAndErrorsNameThem) {
  const auto folder = std::filesystem::temp_directory_path() / ("lfd-pictures-test-" + std::to_string(::getpid()));
  const Picture8 picture = noise(5, 4, true);
  std::filesystem::create_directories(folder / "deep");
  ASSERT_TRUE(write_png(folder / "deep" / "a.png", picture));
  EXPECT_EQ(*read_png(folder / "deep" / "a.png"), picture);
  ASSERT_TRUE(write_exr(folder / "b.exr", special_numbers()));
  EXPECT_EQ(*read_exr(folder / "b.exr"), special_numbers());
  ASSERT_TRUE(write_file(folder / "c.exr", "no picture"));
  EXPECT_THAT(read_exr(folder / "c.exr").error().message(), HasSubstr("c.exr: EXR: "));
  EXPECT_THAT(read_png(folder / "none.png").error().message(), HasSubstr("none.png: no such file"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace lfd
