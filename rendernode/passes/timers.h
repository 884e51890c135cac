// GPU times of passes from timer queries.
#pragma once

#include <string>
#include <vector>

#include "rendernode/gl/objects.h"

namespace lfd {

struct TimedPass {
  std::string pass;
  double gpu_ms = 0;
  std::vector<std::uint32_t> layers;  // empty: all
};

// The queries of one frame. Begin and end do not nest.
class PassTimers {
 public:
  void begin(std::string pass, std::vector<std::uint32_t> layers);
  void end();

  // Waits for the GPU where it must; the times in the order of the passes. Then starts anew.
  std::vector<TimedPass> collect();

 private:
  std::vector<gl::Query> queries_;  // reused from frame to frame
  std::vector<TimedPass> passes_;
};

}  // namespace lfd
