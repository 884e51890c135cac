// Files of finished frames: what they are called and what is in them, whoever writes them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string_view>

#include "base/result.h"
#include "proto/wire.pb.h"

namespace lfd {

// folder/frame-0000: where the images of a frame lie.
std::filesystem::path frame_path(const std::filesystem::path& folder, std::uint64_t frame);

// folder/frame-0000/module-000.color.png, .position.exr, .normal.exr, .ao.exr, .depth.exr or .bent_normal.exr.
std::filesystem::path image_path(const std::filesystem::path& folder, std::uint64_t frame, std::uint32_t module,
                                 proto::BufferKind buffer);

// The frames that lie in a folder: whose folders are there, empty or not. None where the folder cannot be read.
std::set<std::uint64_t> frames_in(const std::filesystem::path& folder);

// folder/report.json: what was drawn, beside the frames.
std::filesystem::path report_path(const std::filesystem::path& folder);

// Removes every file of these names from `folder`, and the folders of frames that are empty then; nothing else. How
// many frames had files.
Result<int> remove_frames(const std::filesystem::path& folder);

// Writes one image as its header says: colour as PNG (RGB), everything else as EXR (R G B A, float32); an empty image
// is all background, or all zero. `pixels`: rows from the top. Missing folders are made.
Status write_image_file(const std::filesystem::path& path, const proto::Image& what, std::string_view pixels);

}  // namespace lfd
