// Tiles by area averages.
#include "display/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "proto/pictures/srgb.h"

namespace lfd::display {
namespace {

constexpr int kLine_px = 2;
constexpr std::uint8_t kLineGray = 64;

// The average over source columns and rows [from, to), never empty.
void average(const Picture8& image, int left, int right, int top, int bottom, std::uint8_t* pixel) {
  const auto& linear = linear_from_srgb8();
  double sum[3] = {};
  for (int row = top; row < bottom; ++row) {
    for (int column = left; column < right; ++column) {
      const std::uint8_t* texel = &image.rgba[4 * (std::size_t(row) * image.width + column)];
      for (int channel = 0; channel < 3; ++channel) sum[channel] += linear[texel[channel]];
    }
  }
  const double count = double(right - left) * (bottom - top);
  for (int channel = 0; channel < 3; ++channel) pixel[channel] = srgb8_from_linear(sum[channel] / count);
}

// First source pixel of tile pixel i.
int source(int i, int tile, int size) { return static_cast<int>(std::int64_t{i} * size / tile); }

void put_tile(const Picture8& image, int width, int height, int x, int y, Picture8& sheet) {
  for (int row = 0; row < height; ++row) {
    const int top = source(row, height, image.height),
              bottom = std::max(top + 1, source(row + 1, height, image.height));
    for (int column = 0; column < width; ++column) {
      const int left = source(column, width, image.width),
                right = std::max(left + 1, source(column + 1, width, image.width));
      average(image, left, right, top, bottom, &sheet.rgba[4 * (std::size_t(y + row) * sheet.width + x + column)]);
    }
  }
}

}  // namespace

Result<Picture8> contact_sheet(std::span<const Picture8* const> images, int tile_width_px) {
  const auto first = std::find_if(images.begin(), images.end(), [](const Picture8* image) { return image != nullptr; });
  if (first == images.end()) return Error("there is no image to put on a sheet");
  const Picture8& like = **first;
  for (std::size_t m = 0; m < images.size(); ++m) {
    if (images[m] != nullptr && (images[m]->width != like.width || images[m]->height != like.height)) {
      return Error(fmt::format("module {}: its image has another size than the others", m));
    }
  }
  const int count = static_cast<int>(images.size() - std::ranges::count(images, nullptr));
  const int columns = static_cast<int>(std::ceil(std::sqrt(double(count))));
  const int rows = (count + columns - 1) / columns;
  if (tile_width_px < 1 || tile_width_px > 8192)
    return Error(fmt::format("tiles of {} pixels; 1 to 8192 are possible", tile_width_px));
  const int tile_height_px =
      std::max(1, static_cast<int>(std::lround(double(tile_width_px) * like.height / like.width)));
  const std::size_t width = std::size_t(columns) * (tile_width_px + kLine_px) + kLine_px;
  const std::size_t height = std::size_t(rows) * (tile_height_px + kLine_px) + kLine_px;
  if (width * height > kMaxPicturePixels)
    return Error(fmt::format("a sheet of {} x {} pixels is too large", width, height));
  Picture8 sheet = black_picture(static_cast<int>(width), static_cast<int>(height));
  for (std::size_t at = 0; at < sheet.rgba.size(); ++at) sheet.rgba[at] = at % 4 == 3 ? 255 : kLineGray;
  int tile = 0;
  for (const Picture8* image : images) {
    if (image == nullptr) continue;
    put_tile(*image, tile_width_px, tile_height_px, kLine_px + (tile % columns) * (tile_width_px + kLine_px),
             kLine_px + (tile / columns) * (tile_height_px + kLine_px), sheet);
    ++tile;
  }
  return sheet;
}

}  // namespace lfd::display
