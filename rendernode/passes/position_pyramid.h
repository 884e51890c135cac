// Positions at ever lower resolutions, for methods of ambient occlusion that read far away coarsely.
#pragma once

#include <string_view>
#include <vector>

#include "base/result.h"
#include "rendernode/gl/objects.h"

namespace lfd {

// All levels lie in one texture, so that neighbours may read different ones: level k, from 1, is its mip level k - 1.
// These are as large as mip levels are, and so larger than what of them is used.
class PositionPyramid {
 public:
  // Level 1 and up; the full picture is not one of them.
  struct Level {
    ImageSize size;  // that is used: of the level before, divided by the factor and rounded up
    gl::Framebuffer framebuffer;
  };

  // Makes so many levels, all anew where there are fewer, or of another factor. Error: the GPU has no memory for them
  // or cannot draw into them; then nothing is kept.
  Status prepare(int factor, int levels, ImageSize full, int layers);

  const std::vector<Level>& levels() const { return levels_; }
  // RGBA32F array, as Targets::position().
  GLuint position() const { return position_.name(); }

 private:
  Status make_framebuffers(std::string_view what);

  int factor_ = 0;
  gl::Texture position_;
  std::vector<Level> levels_;
};

}  // namespace lfd
