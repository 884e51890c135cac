// How far the frame that was timed is from the references: its positions, and its ambient occlusion.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/result.h"
#include "bench/reference/truth.h"
#include "proto/scene_data.h"

namespace lfd {
class Renderer;
}

namespace lfd::bench {

// On how many pixels the ambient occlusion is judged, drawn at random from those with a surface in both pictures, and
// by how many reference samples each.
struct AoSubset {
  int pixels = 500;
  int samples = 4096;
  std::uint64_t seed = 1;
};

// Errors of ambient occlusion after blur and curve, 0 .. 1, against the limit of the method itself (method_limit.h).
struct AoError {
  AoSubset subset;
  std::size_t pixels = 0;     // that were judged
  double mean_absolute = 0;   // MAE
  double standard_error = 0;  // of the MAE, by the choice of pixels
  double mean_signed = 0;     // rendered minus limit
};

struct FrameError {
  reference::Truth position;  // over the ROI diagonal
  AoError ao;
};

// Draws one more frame of `state`, reads positions and ambient occlusion back, and compares. The renderer has one
// module. Errors: the state, the driver, a scene that the reference cannot read.
Result<FrameError> judge_frame(Renderer& renderer, const proto::State& state, const Assets& assets,
                               const AoSubset& subset);

}  // namespace lfd::bench
