// Holds passes over whole pictures to the module's own image and what is needed of the guard band around it.
#pragma once

#include <algorithm>

#include "calibration/spaces/pixel.h"
#include "rendernode/gl/handle.h"

namespace lfd {

// While it lives, what is drawn is cut to the image within a guard band, and `reach` pixels around it. Without a band
// it does nothing. Clearing is cut too.
class Scissor {
 public:
  // `size` is with the band. is_half: what is drawn is of half the resolution (lib/half_resolution.glsl), and the reach
  // one of its pixels more, for those between which the others lie.
  Scissor(int guard_band_px, ImageSize size, ImageSize reach_px = {}, bool is_half = false)
      : is_on_(guard_band_px > 0) {
    if (!is_on_) return;
    const auto [u, width] = range(guard_band_px, size.width, reach_px.width, is_half);
    const auto [v, height] = range(guard_band_px, size.height, reach_px.height, is_half);
    glEnable(GL_SCISSOR_TEST);
    glScissor(u, v, width, height);
  }
  ~Scissor() {
    if (is_on_) glDisable(GL_SCISSOR_TEST);
  }
  Scissor(const Scissor&) = delete;
  Scissor& operator=(const Scissor&) = delete;

 private:
  struct Range {
    int first, count;
  };
  static Range range(int band, int side, int reach, bool is_half) {
    const int first = std::max(0, band - reach), last = std::min(side, side - band + reach) - 1;
    return is_half ? Range{first / 2, last / 2 + 2 - first / 2} : Range{first, last + 1 - first};
  }

  bool is_on_;
};

}  // namespace lfd
