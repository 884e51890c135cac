// Pictures in memory: four interleaved channels, rows from the top.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lfd {

// 8 bits a channel; colours carry the sRGB transfer function, alpha is straight (not multiplied in).
struct Picture8 {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height
  bool operator==(const Picture8&) const = default;
};

// Linear numbers: colours, positions, normals, depths.
struct PictureF {
  int width = 0, height = 0;
  std::vector<float> rgba;  // 4 * width * height
  bool operator==(const PictureF&) const = default;
};

// What is decoded from foreign bytes at most: 64 Mpx, so that no small file can ask for absurd memory.
inline constexpr std::size_t kMaxPicturePixels = std::size_t{1} << 26;

inline Picture8 black_picture(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height)};
}

}  // namespace lfd
