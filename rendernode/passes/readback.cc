// Asynchronous read-back.
#include "rendernode/passes/readback.h"

#include <chrono>
#include <utility>

#include "base/check.h"
#include "base/log.h"
#include "rendernode/gl/memory.h"

namespace lfd {

Readback::~Readback() {
  if (fence_ != nullptr) glDeleteSync(fence_);
}

Status Readback::start(std::vector<ReadbackItem> items, ImageSize size, PixelIndex first) {
  items_ = std::move(items);
  pixels_ = static_cast<std::size_t>(size.width) * size.height;
  offsets_.clear();
  std::size_t total = 0;
  for (const auto& item : items_) {
    offsets_.push_back(total);
    total += pixels_ * item.bytes_per_pixel;
  }
  if (total > capacity_) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    buffer_ = gl::Buffer(name);
    constexpr GLbitfield kAccess = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(total), nullptr, kAccess | GL_CLIENT_STORAGE_BIT);
    mapped_ = static_cast<const std::byte*>(glMapNamedBufferRange(name, 0, static_cast<GLsizeiptr>(total), kAccess));
    capacity_ = mapped_ != nullptr ? total : 0;
    LFD_TRY_STATUS(gl::memory_status(fmt::format("reading {:.0f} MiB of pictures back", total / double{1 << 20})));
    if (mapped_ == nullptr) return Error("the read-back buffer cannot be mapped");
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.name());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const auto& item = items_[i];
    glGetTextureSubImage(item.texture, 0, first.column, first.row, static_cast<GLint>(item.layer), size.width,
                         size.height, 1, item.format, item.type, static_cast<GLsizei>(pixels_ * item.bytes_per_pixel),
                         reinterpret_cast<void*>(offsets_[i]));
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  if (fence_ != nullptr) glDeleteSync(fence_);
  fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
  return {};
}

bool Readback::finished(Clock::duration at_most) {
  LFD_CHECK(fence_ != nullptr, "nothing was started");
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(at_most).count();
  const GLenum state = glClientWaitSync(fence_, 0, static_cast<GLuint64>(nanoseconds));
  return state != GL_TIMEOUT_EXPIRED;  // nor is a fence waited for that the driver has given up
}

std::span<const std::byte> Readback::bytes(std::size_t item) const {
  return {mapped_ + offsets_[item], pixels_ * items_[item].bytes_per_pixel};
}

}  // namespace lfd
