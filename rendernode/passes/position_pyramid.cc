// Textures of the pyramid.
#include "rendernode/passes/position_pyramid.h"

#include <array>

#include "base/log.h"
#include "rendernode/gl/memory.h"

namespace lfd {

Status PositionPyramid::prepare(int factor, int levels, ImageSize full, int layers) {
  if (factor == factor_ && static_cast<int>(levels_.size()) >= levels) return {};
  if (factor != factor_) levels_.clear();
  factor_ = factor;
  while (static_cast<int>(levels_.size()) < levels) {
    const ImageSize before = levels_.empty() ? full : levels_.back().size;
    Level level{{(before.width + factor - 1) / factor, (before.height + factor - 1) / factor}, {}, {}};
    level.position = gl::make_array_texture(GL_RGBA32F, level.size, layers);
    levels_.push_back(std::move(level));
  }
  if (const Status made = gl::memory_status(fmt::format("a pyramid of {} levels", levels)); !made) {
    levels_.clear();
    return made;
  }
  for (Level& level : levels_) {
    if (level.framebuffer) continue;
    const std::array<GLuint, 1> colors{level.position.name()};
    level.framebuffer = gl::make_layered_framebuffer(colors, 0);
  }
  return {};
}

}  // namespace lfd
