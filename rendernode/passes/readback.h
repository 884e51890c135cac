// Bringing finished buffers to the CPU without waiting: copies into a mapped buffer, then a fence.
#pragma once

#include <span>
#include <vector>

#include "base/clock.h"
#include "base/result.h"
#include "calibration/spaces/pixel.h"
#include "proto/wire.pb.h"
#include "rendernode/gl/objects.h"

namespace lfd {

// One texture layer on its way.
struct ReadbackItem {
  std::uint32_t layer = 0;
  proto::BufferKind kind = proto::COLOR;
  GLuint texture = 0;
  GLenum format = GL_RGBA, type = GL_UNSIGNED_BYTE;  // of the pixels as they are wanted
  std::size_t bytes_per_pixel = 4;
};

class Readback {
 public:
  Readback() = default;
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  // Submits the copies and a fence, of `size` pixels from `first` on. The item's bytes are valid from finished() until
  // the next start(). Error: no memory for the buffer.
  Status start(std::vector<ReadbackItem> items, ImageSize size, PixelIndex first = {});

  // Whether the GPU has done everything up to and with the copies; waits at most so long.
  bool finished(Clock::duration at_most);

  const std::vector<ReadbackItem>& items() const { return items_; }
  std::span<const std::byte> bytes(std::size_t item) const;

 private:
  std::vector<ReadbackItem> items_;
  std::vector<std::size_t> offsets_;
  std::size_t pixels_ = 0;
  gl::Buffer buffer_;
  std::size_t capacity_ = 0;
  const std::byte* mapped_ = nullptr;
  GLsync fence_ = nullptr;
};

}  // namespace lfd
