// The draws of a frame as the GPU reads them: indirect commands, one record each, and the list of layers.
#pragma once

#include <vector>

#include "rendernode/gl/objects.h"
#include "rendernode/plan/frame_plan.h"

namespace lfd {

// A range of commands that one glMultiDrawElementsIndirect makes.
struct Submission {
  int texture_group = -1;
  bool alpha_mask = false;
  std::uint32_t first_command = 0, count = 0;
};

// Layers that are drawn together, and their draws. Normally a frame is one batch; where times are asked for per module,
// each module is a batch of its own.
struct Batch {
  std::uint32_t first_layer = 0, layer_count = 0;  // in the buffer of layers
  std::vector<std::uint32_t> layers;
  std::vector<Submission> submissions;
};

struct CommandList {
  gl::Buffer commands, records, layers;
  std::vector<Batch> batches;
};

CommandList make_commands(const FramePlan& plan, const std::vector<GeometryItem>& items,
                          const std::vector<MaterialFacts>& materials, bool batch_per_module);

}  // namespace lfd
