// GPU times of passes from timer queries.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rendernode/gl/objects.h"

namespace lfd {

struct TimedPass {
  std::string pass;
  double gpu_ms = 0;
  std::vector<std::uint32_t> layers;  // empty: all
};

// Passes that find ambient occlusion, up to where it is known for every pixel; and those that blur it.
inline bool is_occlusion_pass(std::string_view pass) {
  return pass == "pyramid" || pass == "ao" || pass == "ao_upsample" || pass == "share";
}
inline bool is_blur_pass(std::string_view pass) { return pass.starts_with("blur"); }

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
