// Writing frames.
#include "proto/frame_files.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <regex>
#include <vector>

#include "base/file.h"
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
    case proto::BENT_NORMAL:
      return "bent_normal.exr";
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

// What lies in a folder under such names.
std::vector<std::filesystem::path> entries_named(const std::filesystem::path& folder, const std::regex& name) {
  std::vector<std::filesystem::path> found;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    if (std::regex_match(entry->path().filename().string(), name)) found.push_back(entry->path());
  }
  return found;
}

}  // namespace

std::filesystem::path frame_path(const std::filesystem::path& folder, std::uint64_t frame) {
  return folder / fmt::format("frame-{:04}", frame);
}

std::filesystem::path image_path(const std::filesystem::path& folder, std::uint64_t frame, std::uint32_t module,
                                 proto::BufferKind buffer) {
  return frame_path(folder, frame) / fmt::format("module-{:03}.{}", module, ending(buffer));
}

std::set<std::uint64_t> frames_in(const std::filesystem::path& folder) {
  constexpr std::string_view kPrefix = "frame-";
  std::set<std::uint64_t> frames;
  std::error_code failure;
  for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(kPrefix)) continue;
    std::uint64_t frame = 0;
    const auto [rest, error] = std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), frame);
    if (error == std::errc() && rest == name.data() + name.size()) frames.insert(frame);
  }
  return frames;
}

std::filesystem::path report_path(const std::filesystem::path& folder) { return folder / "report.json"; }

Result<int> remove_frames(const std::filesystem::path& folder) {
  static const std::regex frame_name("frame-[0-9]{4,}");
  static const std::regex image_name("module-[0-9]{3,}\\.(color\\.png|(position|normal|ao|depth|bent_normal)\\.exr)");
  std::vector<std::filesystem::path> files;
  const auto frames = entries_named(folder, frame_name);
  int with_images = 0;
  for (const std::filesystem::path& frame : frames) {
    const auto images = entries_named(frame, image_name);
    files.insert(files.end(), images.begin(), images.end());
    if (!images.empty()) ++with_images;
  }
  files.push_back(report_path(folder));
  std::error_code failure;
  for (const std::filesystem::path& file : files) {
    std::filesystem::remove(file, failure);
    if (failure) return Error(fmt::format("{}: {}", file.string(), failure.message()));
  }
  // One that holds anything else stays.
  for (const std::filesystem::path& frame : frames) std::filesystem::remove(frame, failure);
  return with_images;
}

Status write_image_file(const std::filesystem::path& path, const proto::Image& what, std::string_view pixels) {
  LFD_TRY_STATUS(make_folder(path.parent_path()));
  if (what.buffer() == proto::COLOR) return write_png(path, color_picture(what, pixels), PngChannels::kRgb);
  return write_exr(path, float_picture(what, pixels));
}

}  // namespace lfd
