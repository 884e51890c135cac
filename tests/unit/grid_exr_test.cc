// Grids in OpenEXR files: which channels they are, and headers that are refused before OpenEXR believes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "proto/grid_files.h"
#include "proto/pictures/exr.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string error_of(std::string_view name, std::string_view content) {
  const auto nodes = parse_grid_file(name, content);
  return nodes ? "" : nodes.error().message();
}

// The bytes of a number as the file has them, the least significant first.
std::string whole(std::uint32_t number) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>((number >> shift) & 0xff));
  return bytes;
}

// The size that a file says its list of channels has.
std::uint32_t channels_bytes(std::string_view file) {
  using namespace std::string_view_literals;
  const std::string_view list = "channels\0chlist\0"sv;
  std::uint32_t size = 0;
  std::memcpy(&size, file.data() + file.find(list) + list.size(), sizeof size);
  return size;
}

TEST(GridExr, HasChannelsRedAndGreenOrSAndY) {
  PictureF picture{2, 2, {}};
  picture.rgba = {-1, 1, 7, 7, 1, 1.5, 7, 7, -1.5, -1, 7, 7, 0.5, -1, 7, 7};
  const auto file = encode_exr(picture);
  ASSERT_TRUE(file);
  const auto nodes = parse_grid_file("g.exr", *file);
  ASSERT_TRUE(nodes) << nodes.error().message();
  EXPECT_EQ(nodes->at(1, 0), (ScreenPoint{1, 1.5}));
  EXPECT_EQ(nodes->at(0, 1), (ScreenPoint{-1.5, -1}));
  // The same file with G called s and R called y: two channels may stand anywhere in it.
  std::string renamed = *file;
  const auto rename = [&renamed](char from, char to) {
    const std::size_t at = renamed.find(std::string{from, '\0', '\2'});  // 2: float32
    ASSERT_NE(at, renamed.npos);
    renamed[at] = to;
  };
  rename('G', 's');
  rename('R', 'y');
  const auto swapped = parse_grid_file("g.exr", renamed);
  ASSERT_TRUE(swapped) << swapped.error().message();
  EXPECT_EQ(swapped->at(1, 0), (ScreenPoint{1.5, 1}));
  rename('s', 'u');
  EXPECT_EQ(error_of("g.exr", renamed), "EXR: no channel R");
  EXPECT_THAT(error_of("g.exr", file->substr(0, file->size() / 2)), StartsWith("EXR: "));
  EXPECT_THAT(error_of("g.exr", "no picture"), StartsWith("EXR: "));
}

// OpenEXR makes its buffers while it opens a file: what is too large must be refused before.
TEST(GridExr, IsRefusedByItsHeaderAlone) {
  const std::string sound = *encode_exr({2, 2, std::vector<float>(16, 0.5F)});
  const auto with = [&sound](std::string_view after, std::string_view bytes) {
    std::string file = sound;
    const std::size_t at = file.find(after);
    EXPECT_NE(at, file.npos);
    return file.replace(at + after.size(), bytes.size(), bytes);
  };
  using namespace std::string_literals;
  using namespace std::string_view_literals;
  const std::string_view window = "dataWindow\0box2i\0\x10\0\0\0"sv;
  EXPECT_EQ(error_of("g.exr", sound), "pixel (0, 0): s: at the same place of the screen as column 1, row 0");
  EXPECT_THAT(error_of("g.exr", with(window, whole(0) + whole(0) + whole(7'999'999) + whole(1))),
              StartsWith("EXR: 8000000 x 2 pixels; at most"));
  EXPECT_THAT(error_of("g.exr", with(window, whole(0x80000000U) + whole(0) + whole(0x7fffffffU) + whole(1))),
              StartsWith("EXR: 4294967296 x 2 pixels"));
  EXPECT_THAT(error_of("g.exr", with(window, whole(5) + whole(0) + whole(4) + whole(1))), StartsWith("EXR: 0 x 2"));
  EXPECT_THAT(error_of("g.exr", with("dataWindow\0box2i\0"sv, whole(0x7fffffffU))),
              StartsWith("EXR: attribute dataWindow: 2147483647 bytes"));
  EXPECT_THAT(error_of("g.exr", with("\x76\x2f\x31\x01"sv, whole(0x202))), HasSubstr("only one picture of scanlines"));
  // OpenEXR reads channels to the end of their list, whatever its size says, and takes what follows for an attribute.
  EXPECT_EQ(error_of("g.exr", with("channels\0chlist\0"sv, whole(channels_bytes(sound) + 1))),
            "EXR: channels: the list ends before its size");
  EXPECT_EQ(error_of("g.exr", with("compression\0compression\0"sv, whole(2))),
            "EXR: attribute compression: 2 bytes are no compression");
  for (const auto& [type, value] : {std::pair{"preview"sv, whole(1 << 15) + whole(1 << 15) + "pixels"},
                                    {"stringvector"sv, whole(0x52000000) + "text"},
                                    {"floatvector"sv, std::string("abc")}}) {
    std::string more = sound;
    more.insert(8, "own\0"s + std::string(type) + "\0"s + whole(static_cast<std::uint32_t>(value.size())) + value);
    EXPECT_THAT(error_of("g.exr", more), StartsWith("EXR: attribute own: ")) << type;
  }
  std::string unnamed = sound;
  unnamed.replace(unnamed.find("dataWindow"), 10, "dataWindoe");
  EXPECT_EQ(error_of("g.exr", unnamed), "EXR: no dataWindow");
  std::string channels;  // 65 of them
  for (char c = 0; c < 65; ++c) channels += std::string{'c', static_cast<char>('0' + c)} + std::string(17, '\0');
  std::string crowded = sound;
  const std::string_view list = "channels\0chlist\0"sv;
  crowded.erase(crowded.find(list) + list.size(), 4);
  crowded.insert(crowded.find(list) + list.size(), whole(static_cast<std::uint32_t>(channels.size())) + channels);
  EXPECT_EQ(error_of("g.exr", crowded), "EXR: channels: more than 64");
}

}  // namespace
}  // namespace lfd
