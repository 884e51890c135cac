// A few threads that each write one module's images at a time.
#include "display/picture_writer.h"

#include <algorithm>
#include <mutex>

#include "base/failure_news.h"
#include "base/log.h"
#include "calibration/display.h"
#include "proto/frame_files.h"
#include "proto/images/image_payload.h"

namespace lfd::display {
namespace {

using namespace std::chrono_literals;

constexpr unsigned kMaxWorkers = 8;
constexpr auto kPatience = 1s;  // of a waiting worker, before it looks again

struct Job {
  explicit Job(ShownFrame&& f) : frame(std::move(f)) {}
  const ShownFrame frame;
  std::atomic<std::size_t> modules_left = 0;
};

struct Task {
  std::shared_ptr<Job> job;
  std::uint32_t module = 0;
};

}  // namespace

struct PictureWriter::Shared {
  explicit Shared(std::filesystem::path f) : folder(std::move(f)) {}

  void work();
  void write_module(const Job& job, std::uint32_t module);
  Status write(const std::filesystem::path& path, const ReceivedImage& image) const;
  void note(const std::filesystem::path& path, const Status& status);

  const std::filesystem::path folder;
  wire::Mailbox<Task> tasks{kFrames * kMaxModules};
  wire::Mailbox<Written> written{kFrames};
  std::atomic<bool> ends = false;
  std::atomic<unsigned> working = 0;  // threads
  std::atomic<std::uint64_t> failed = 0;
  std::mutex news_mutex;
  FailureNews news;
};

PictureWriter::PictureWriter(std::filesystem::path folder) : shared_(std::make_shared<Shared>(std::move(folder))) {
  const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1u, kMaxWorkers);
  shared_->working = count;
  for (unsigned i = 0; i < count; ++i) workers_.emplace_back([shared = shared_] { shared->work(); });
}

PictureWriter::~PictureWriter() {
  shared_->ends = true;
  shared_->tasks.close();
  const auto until = Clock::now() + kLastWrites;
  while (shared_->working > 0 && Clock::now() < until) std::this_thread::sleep_for(1ms);
  const bool ended = shared_->working == 0;
  for (std::thread& worker : workers_) ended ? worker.join() : worker.detach();
}

void PictureWriter::write(ShownFrame frame) {
  LFD_CHECK(accepts(), "more frames than fit");
  const std::size_t modules = frame.modules.size();
  LFD_CHECK(modules >= 1 && modules <= kMaxModules, "a frame of no display");
  auto job = std::make_shared<Job>(std::move(frame));
  job->modules_left = modules;
  ++frames_in_hand_;
  for (std::uint32_t module = 0; module < modules; ++module) {
    const bool fits = shared_->tasks.put(Task{job, module});
    LFD_CHECK(fits, "the queue holds kFrames frames of kMaxModules");
  }
}

std::optional<Written> PictureWriter::take_written() {
  auto written = shared_->written.take();
  if (written) --frames_in_hand_;
  return written;
}

int PictureWriter::descriptor() const { return shared_->written.descriptor(); }
std::uint64_t PictureWriter::failed_images() const { return shared_->failed; }

void PictureWriter::Shared::work() {
  while (!ends) {
    auto task = tasks.take_within(kPatience);
    if (!task) continue;
    write_module(*task->job, task->module);
    if (--task->job->modules_left > 0) continue;
    const bool fits = written.put(Written{task->job->frame.frame, task->job->frame.fresh_modules});
    LFD_CHECK(fits, "no more than kFrames are in hand");
  }
  --working;
}

void PictureWriter::Shared::write_module(const Job& job, std::uint32_t module) {
  for (const auto& image : job.frame.modules[module].image) {
    if (image == nullptr || ends) continue;
    const auto path = image_path(folder, job.frame.frame, module, image->what.buffer());
    const Status status = write(path, *image);
    if (!ends) note(path, status);
  }
}

Status PictureWriter::Shared::write(const std::filesystem::path& path, const ReceivedImage& image) const {
  if (image.what.empty()) return write_image_file(path, image.what, {});
  const auto pixels = decode_payload(image.what, image.payload);
  if (!pixels) return pixels.error().within(path.string());
  return write_image_file(path, image.what, pixels->text());
}

void PictureWriter::Shared::note(const std::filesystem::path& path, const Status& status) {
  const std::lock_guard lock(news_mutex);
  if (status) {
    if (const auto missing = news.worked(Clock::now())) log::info("pictures are written again; {} failed", *missing);
    return;
  }
  ++failed;
  const std::string& message = status.error().message();
  // The reason is the same for all frames: without the path in front, and the folder of this one.
  std::string reason = message.substr(message.rfind(": ") + 1);
  if (const auto at = reason.find(path.parent_path().string()); at != reason.npos)
    reason.erase(at, path.parent_path().string().size());
  if (!news.failed(reason, Clock::now())) return;
  log::error("{}; frames go on, further pictures that fail for this reason are only counted", message);
  log::debug("the first of them: {}", path.string());
}

}  // namespace lfd::display
