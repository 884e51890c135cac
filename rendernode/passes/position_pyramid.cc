// Textures of the pyramid.
#include "rendernode/passes/position_pyramid.h"

#include <algorithm>
#include <array>

#include "base/log.h"
#include "rendernode/gl/memory.h"

namespace lfd {
namespace {

ImageSize divided(ImageSize size, int factor) {
  return {(size.width + factor - 1) / factor, (size.height + factor - 1) / factor};
}

// The smallest size of a mip level 0 of which every further one, half as large and rounded down, holds its level.
ImageSize size_for(const std::vector<PositionPyramid::Level>& levels) {
  ImageSize size{1, 1};
  for (std::size_t mip = 0; mip < levels.size(); ++mip) {
    size.width = std::max(size.width, levels[mip].size.width << mip);
    size.height = std::max(size.height, levels[mip].size.height << mip);
  }
  return size;
}

}  // namespace

Status PositionPyramid::prepare(int factor, int levels, ImageSize full, int layers) {
  if (factor == factor_ && static_cast<int>(levels_.size()) >= levels) return {};
  *this = PositionPyramid();
  factor_ = factor;
  for (ImageSize size = full; static_cast<int>(levels_.size()) < levels;) {
    size = divided(size, factor);
    levels_.push_back({size, {}});
  }
  position_ = gl::make_array_texture(GL_RGBA32F, size_for(levels_), layers, levels);
  Status made = make_framebuffers(fmt::format("a pyramid of {} levels", levels));
  if (!made) *this = PositionPyramid();
  return made;
}

Status PositionPyramid::make_framebuffers(std::string_view what) {
  LFD_TRY_STATUS(gl::memory_status(what));
  const std::array<GLuint, 1> colors{position_.name()};
  for (std::size_t mip = 0; mip < levels_.size(); ++mip) {
    LFD_TRY(levels_[mip].framebuffer, gl::make_layered_framebuffer(colors, 0, what, static_cast<GLint>(mip)));
  }
  return {};
}

}  // namespace lfd
