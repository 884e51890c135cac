// Writes shown frames to files on threads of its own, so that the network never waits for a disk.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "display/frame_assembly.h"
#include "proto/wire/mailbox.h"

namespace lfd::display {

struct Written {
  std::uint64_t frame = 0;
  int fresh_modules = 0;
};

// Frames are written whole, begun in the order given; at most kFrames are in hand. What cannot be written (disk full,
// folder gone) is counted and logged, once per cause; the frame counts as written all the same. One thread uses it.
class PictureWriter {
 public:
  static constexpr std::size_t kFrames = 2;

  explicit PictureWriter(std::filesystem::path folder);
  // Ends within the time that the images now being written need; what waits is left out.
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  bool accepts() const { return frames_in_hand_ < kFrames; }
  // Only while it accepts.
  void write(ShownFrame frame);
  // The next frame that has been written.
  std::optional<Written> take_written();
  // Readable while take_written() has something.
  int descriptor() const { return written_.descriptor(); }

  std::uint64_t failed_images() const { return failed_; }

 private:
  struct Job {
    explicit Job(ShownFrame&& f) : frame(std::move(f)) {}
    const ShownFrame frame;
    std::atomic<std::size_t> modules_left = 0;
  };
  struct Task {
    std::shared_ptr<Job> job;
    std::uint32_t module = 0;
  };

  void work();
  void write_module(const Job& job, std::uint32_t module);
  void note_failure(const std::filesystem::path& path, const std::string& message);

  const std::filesystem::path folder_;
  std::size_t frames_in_hand_ = 0;
  wire::Mailbox<Task> tasks_;
  wire::Mailbox<Written> written_{kFrames};
  std::atomic<bool> ends_ = false;
  std::atomic<std::uint64_t> failed_ = 0;
  std::mutex causes_mutex_;
  std::set<std::string> causes_;  // logged already
  std::vector<std::jthread> workers_;
};

}  // namespace lfd::display
