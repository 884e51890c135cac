// A few threads that each write one module's images at a time.
#include "display/picture_writer.h"

#include <algorithm>
#include <cstring>

#include "base/log.h"
#include "calibration/display.h"
#include "display/frame_folder.h"
#include "display/srgb.h"
#include "proto/pictures/exr.h"
#include "proto/pictures/png.h"

namespace lfd::display {
namespace {

constexpr unsigned kMaxWorkers = 8;
constexpr auto kPatience = std::chrono::seconds(1);  // of a waiting worker, before it looks again

Picture8 color_picture(const ReceivedImage& image, ImageSize size) {
  Picture8 picture = black_picture(size.width, size.height);
  if (!image.what.empty()) {
    std::memcpy(picture.rgba.data(), image.pixels.bytes().data(), std::min(picture.rgba.size(), image.pixels.size()));
    return picture;
  }
  const auto& background = image.what.background();
  const std::uint8_t pixel[4] = {srgb8_from_linear(background.r()), srgb8_from_linear(background.g()),
                                 srgb8_from_linear(background.b()), 255};
  for (std::size_t at = 0; at < picture.rgba.size(); ++at) picture.rgba[at] = pixel[at % 4];
  return picture;
}

PictureF float_picture(const ReceivedImage& image, ImageSize size) {
  PictureF picture{size.width, size.height, std::vector<float>(std::size_t{4} * size.width * size.height)};
  const std::size_t bytes = std::min(picture.rgba.size() * sizeof(float), image.pixels.size());
  if (bytes > 0) std::memcpy(picture.rgba.data(), image.pixels.bytes().data(), bytes);
  return picture;
}

}  // namespace

Status write_image(const std::filesystem::path& path, const ReceivedImage& image, ImageSize size) {
  if (image.what.buffer() == proto::COLOR) return write_png(path, color_picture(image, size), PngChannels::kRgb);
  return write_exr(path, float_picture(image, size));
}

PictureWriter::PictureWriter(std::filesystem::path folder) : folder_(std::move(folder)), tasks_(kFrames * kMaxModules) {
  const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1u, kMaxWorkers);
  for (unsigned i = 0; i < count; ++i) workers_.emplace_back([this] { work(); });
}

PictureWriter::~PictureWriter() {
  ends_ = true;
  tasks_.close();
}

void PictureWriter::write(ShownFrame frame, ImageSize size) {
  LFD_CHECK(accepts(), "more frames than fit");
  const std::size_t modules = frame.modules.size();
  LFD_CHECK(modules >= 1 && modules <= kMaxModules, "a frame of no display");
  auto job = std::make_shared<Job>(std::move(frame), size);
  job->modules_left = modules;
  ++frames_in_hand_;
  for (std::uint32_t module = 0; module < modules; ++module) {
    const bool fits = tasks_.put(Task{job, module});
    LFD_CHECK(fits, "the queue holds kFrames frames of kMaxModules");
  }
}

std::optional<Written> PictureWriter::take_written() {
  auto written = written_.take();
  if (written) --frames_in_hand_;
  return written;
}

void PictureWriter::work() {
  while (!ends_) {
    auto task = tasks_.take_within(kPatience);
    if (!task) continue;
    write_module(*task->job, task->module);
    if (--task->job->modules_left > 0) continue;
    const bool fits = written_.put(Written{task->job->frame.frame, task->job->frame.fresh_modules});
    LFD_CHECK(fits, "no more than kFrames are in hand");
  }
}

void PictureWriter::write_module(const Job& job, std::uint32_t module) {
  for (const auto& image : job.frame.modules[module].image) {
    if (image == nullptr || ends_) continue;
    const auto path = image_path(folder_, job.frame.frame, module, image->what.buffer());
    if (const Status status = write_image(path, *image, job.size); !status)
      note_failure(path, status.error().message());
  }
}

void PictureWriter::note_failure(const std::filesystem::path& path, const std::string& message) {
  ++failed_;
  const std::string cause = message.substr(message.rfind(": ") + 1);  // without the path in front
  const std::lock_guard lock(causes_mutex_);
  if (!causes_.insert(cause).second) return;
  log::error("{}; frames go on, further pictures that fail for this reason are only counted", message);
  log::debug("the first of them: {}", path.string());
}

}  // namespace lfd::display
