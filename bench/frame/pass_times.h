// Times of the passes of frames drawn in turn without and with ambient occlusion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "bench/common/spread.h"
#include "proto/scene_data.h"

namespace lfd {
class Renderer;
}

namespace lfd::bench {

// Milliseconds. Absent: a frame of this kind does not have the pass.
struct PassRow {
  std::string pass;
  std::optional<Spread> without_ao, with_ao;

  double difference_of_means() const { return mean(with_ao) - mean(without_ao); }
  double difference_of_medians() const { return median(with_ao) - median(without_ao); }

 private:
  static double mean(const std::optional<Spread>& spread) { return spread ? spread->mean : 0; }
  static double median(const std::optional<Spread>& spread) { return spread ? spread->median : 0; }
};

struct PassTimes {
  int frames = 0;             // of each kind
  std::vector<PassRow> pass;  // GPU timer queries, in the order of the passes
  PassRow sum;                // of the passes of each frame
  PassRow wall;               // clock of this process, from the planning of a frame until the GPU is done with it
  std::vector<std::string> left_out_without_ao, left_out_with_ao;  // by the planner: "pass ao: switched off"
};

// Draws `frames` frames of each kind, in turn, after a few that are not counted; nothing is read back and nothing used
// again. `state` is the one with ambient occlusion; the renderer is left with it.
Result<PassTimes> time_passes(Renderer& renderer, const proto::State& state, const Assets& assets, int frames);

}  // namespace lfd::bench
