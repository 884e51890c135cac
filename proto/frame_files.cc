// Writing frames.
#include "proto/frame_files.h"

#include <algorithm>
#include <cstring>

#include "base/log.h"
#include "proto/pictures/exr.h"
#include "proto/pictures/png.h"
#include "proto/pictures/srgb.h"

namespace lfd {
namespace {

const char* ending(proto::BufferKind buffer) {
  switch (buffer) {
    case proto::COLOR:
      return "color.png";
    case proto::POSITION:
      return "position.exr";
    case proto::NORMAL:
      return "normal.exr";
    case proto::AO:
      return "ao.exr";
    default:
      return "depth.exr";
  }
}

Picture8 color_picture(const proto::Image& what, std::string_view pixels) {
  Picture8 picture = black_picture(static_cast<int>(what.width_px()), static_cast<int>(what.height_px()));
  if (!what.empty()) {
    std::memcpy(picture.rgba.data(), pixels.data(), std::min(picture.rgba.size(), pixels.size()));
    return picture;
  }
  const auto& background = what.background();
  const std::uint8_t pixel[4] = {srgb8_from_linear(background.r()), srgb8_from_linear(background.g()),
                                 srgb8_from_linear(background.b()), 255};
  for (std::size_t at = 0; at < picture.rgba.size(); ++at) picture.rgba[at] = pixel[at % 4];
  return picture;
}

PictureF float_picture(const proto::Image& what, std::string_view pixels) {
  PictureF picture{static_cast<int>(what.width_px()), static_cast<int>(what.height_px()),
                   std::vector<float>(std::size_t{4} * what.width_px() * what.height_px())};
  const std::size_t bytes = std::min(picture.rgba.size() * sizeof(float), pixels.size());
  if (bytes > 0) std::memcpy(picture.rgba.data(), pixels.data(), bytes);
  return picture;
}

}  // namespace

std::filesystem::path frame_path(const std::filesystem::path& folder, std::uint64_t frame) {
  return folder / fmt::format("frame-{:04}", frame);
}

std::filesystem::path image_path(const std::filesystem::path& folder, std::uint64_t frame, std::uint32_t module,
                                 proto::BufferKind buffer) {
  return frame_path(folder, frame) / fmt::format("module-{:03}.{}", module, ending(buffer));
}

Status write_image_file(const std::filesystem::path& path, const proto::Image& what, std::string_view pixels) {
  if (what.buffer() == proto::COLOR) return write_png(path, color_picture(what, pixels), PngChannels::kRgb);
  return write_exr(path, float_picture(what, pixels));
}

}  // namespace lfd
