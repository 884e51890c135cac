// Threads that each encode one image at a time.
#include "rendernode/node/frame_encoder.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/check.h"
#include "base/hash.h"

namespace lfd::node {
namespace {

constexpr unsigned kMaxWorkers = 8;
constexpr std::size_t kMaxTasks = std::size_t{1} << 20;
constexpr auto kPatience = std::chrono::seconds(1);  // of a waiting worker, before it looks again

bool are_equal(const proto::Stream& a, const proto::Stream& b) {
  return a.codec() == b.codec() && a.has_level() == b.has_level() && a.level() == b.level() &&
         a.has_quality() == b.has_quality() && a.quality() == b.quality();
}

}  // namespace

FrameEncoder::FrameEncoder() : tasks_(kMaxTasks), done_(64) {
  const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1u, kMaxWorkers);
  for (unsigned i = 0; i < count; ++i) workers_.emplace_back([this] { work(); });
}

FrameEncoder::~FrameEncoder() {
  give_up();
  ends_ = true;
  tasks_.close();
}

void FrameEncoder::put(const proto::Stream& stream, std::vector<OutgoingImage> images) {
  LFD_CHECK(idle(), "a frame is in hand already");
  if (!are_equal(stream, stream_)) last_.clear();
  stream_ = stream;
  job_ = std::make_shared<Job>();
  job_->stream = stream;
  job_->images = std::move(images);
  std::vector<Task> tasks;
  for (OutgoingImage& image : job_->images) {
    if (image.payload.empty()) continue;  // all background
    auto& last = last_[{image.header.module(), image.header.buffer()}];
    if (last == nullptr) last = std::make_shared<Last>();
    tasks.push_back({job_, &image, last});
  }
  job_->left = tasks.size();
  if (tasks.empty()) hand_back(job_);
  for (Task& task : tasks) {
    const bool fits = tasks_.put(std::move(task));
    LFD_CHECK(fits, "the queue holds a frame of any display");
  }
}

void FrameEncoder::hand_back(std::shared_ptr<Job> job) {
  const bool fits = done_.put(std::move(job));
  LFD_CHECK(fits, "hardly more than one frame is in hand");
}

std::optional<std::vector<OutgoingImage>> FrameEncoder::take() {
  while (auto done = done_.take()) {
    if (*done != job_) continue;  // it was given up in the last moment
    job_.reset();
    return std::move((*done)->images);
  }
  return std::nullopt;
}

void FrameEncoder::give_up() {
  if (job_) job_->gives_up = true;
  job_.reset();
  last_.clear();  // a worker may be at one of them still
}

void FrameEncoder::work() {
  PayloadEncoder encoder;
  while (!ends_) {
    auto task = tasks_.take_within(kPatience);
    if (!task) continue;
    Job& job = *task->job;
    if (!job.gives_up) encode(encoder, job, *task->image, *task->last);
    if (--job.left == 0 && !job.gives_up) hand_back(std::move(task->job));
  }
}

void FrameEncoder::encode(PayloadEncoder& encoder, const Job& job, OutgoingImage& image, Last& last) {
  const wire::Payload pixels = std::move(image.payload);
  if (last.pixels.lock() != pixels.owner()) {
    std::string hash = content_hash(pixels.bytes());
    if (hash != last.hash) {
      auto encoded = encoder.encode(job.stream, image.header, pixels, &job.gives_up);
      if (!encoded) return;
      last.encoding = encoded->encoding;
      last.payload = std::move(encoded->payload);
      last.hash = std::move(hash);
    }
    last.pixels = pixels.owner();
  }
  image.header.set_encoding(last.encoding);
  image.payload = last.payload;
}

}  // namespace lfd::node
