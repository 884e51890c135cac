// Positions at ever lower resolutions, for methods of ambient occlusion that read far away coarsely.
#pragma once

#include <vector>

#include "base/result.h"
#include "rendernode/gl/objects.h"

namespace lfd {

class PositionPyramid {
 public:
  // Level 1 and up; the full picture is not one of them.
  struct Level {
    ImageSize size;        // of the level before, divided by the factor and rounded up
    gl::Texture position;  // RGBA32F array, as Targets::position()
    gl::Framebuffer framebuffer;
  };

  // Makes the levels that are not there yet. Error: the GPU has no memory for them; then nothing is kept.
  Status prepare(int factor, int levels, ImageSize full, int layers);

  const std::vector<Level>& levels() const { return levels_; }

 private:
  int factor_ = 0;
  std::vector<Level> levels_;
};

}  // namespace lfd
