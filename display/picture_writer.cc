// A few threads that each write one module's images at a time.
#include "display/picture_writer.h"

#include <algorithm>

#include "base/log.h"
#include "calibration/display.h"
#include "proto/frame_files.h"

namespace lfd::display {
namespace {

constexpr unsigned kMaxWorkers = 8;
constexpr auto kPatience = std::chrono::seconds(1);  // of a waiting worker, before it looks again

}  // namespace

PictureWriter::PictureWriter(std::filesystem::path folder) : folder_(std::move(folder)), tasks_(kFrames * kMaxModules) {
  const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1u, kMaxWorkers);
  for (unsigned i = 0; i < count; ++i) workers_.emplace_back([this] { work(); });
}

PictureWriter::~PictureWriter() {
  ends_ = true;
  tasks_.close();
}

void PictureWriter::write(ShownFrame frame) {
  LFD_CHECK(accepts(), "more frames than fit");
  const std::size_t modules = frame.modules.size();
  LFD_CHECK(modules >= 1 && modules <= kMaxModules, "a frame of no display");
  auto job = std::make_shared<Job>(std::move(frame));
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
    if (const Status status = write_image_file(path, image->what, image->pixels.text()); !status)
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
