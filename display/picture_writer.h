// Writes shown frames to files on threads of its own, so that the network never waits for a disk.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
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

// Frames are decoded and written whole, begun in the order given; at most kFrames are in hand. What cannot be decoded
// or written (disk full, folder gone) is counted and logged, once per cause until pictures are written again; the frame
// counts as written all the same. One thread uses it.
class PictureWriter {
 public:
  static constexpr std::size_t kFrames = 2;

  explicit PictureWriter(std::filesystem::path folder);
  // Ends within the time that the images now being written need, at most kLastWrites; what waits is left out. A disk
  // that hangs cannot be interrupted: its thread is left to itself.
  ~PictureWriter();
  static constexpr Clock::duration kLastWrites = std::chrono::seconds(1);
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  bool accepts() const { return frames_in_hand_ < kFrames; }
  // Only while it accepts.
  void write(ShownFrame frame);
  // The next frame that has been written.
  std::optional<Written> take_written();
  // Readable while take_written() has something.
  int descriptor() const;

  std::uint64_t failed_images() const;

 private:
  struct Shared;  // with the threads, which may live longer

  std::shared_ptr<Shared> shared_;
  std::size_t frames_in_hand_ = 0;
  std::vector<std::thread> workers_;
};

}  // namespace lfd::display
