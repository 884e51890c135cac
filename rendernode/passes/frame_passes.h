// Submits the six passes of a frame (Doronin et al., WSCG 2017, section 7) for all modules of the node at once, or the
// one that draws test patterns instead.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "proto/settings.h"
#include "rendernode/geometry/depth_limits.h"
#include "rendernode/gl/program.h"
#include "rendernode/passes/command_list.h"
#include "rendernode/passes/gpu_modules.h"
#include "rendernode/passes/gpu_scene.h"
#include "rendernode/passes/targets.h"
#include "rendernode/passes/timers.h"

namespace lfd {

// Everything a frame is drawn from; all of it outlives the calls.
struct FrameInputs {
  const GpuModules& modules;
  const GpuMaterials& materials;
  const GpuGeometry& geometry;
  const GpuLights& lights;
  const RegionOfInterest& roi;
  const RenderSettings& settings;
  const DepthLimits& limits;
  const DisplayCalibration& display;
};

class FramePasses {
 public:
  FramePasses();

  // Submits all passes of the plan; nothing waits. Errors: a shader that the driver does not compile.
  Status submit(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs, Targets& targets,
                PassTimers& timers);

 private:
  Result<GLuint> program(const std::vector<std::string>& stages, const gl::Flags& flags);
  void bind_inputs(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs);
  Status draw_surfaces(const char* fragment, gl::Flags flags, const Batch& batch, const FrameInputs& inputs);
  Status z_prepass(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs, Targets& targets,
                   PassTimers& timers);
  Status gbuffer(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs, Targets& targets,
                 PassTimers& timers);
  Status pyramid(const FramePlan& plan, const CommandList& commands, const Targets& targets, PassTimers& timers);
  Status ambient_occlusion(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs,
                           const Targets& targets, PassTimers& timers);
  Status upsample(const FramePlan& plan, const CommandList& commands, const AoSettings& ao, const Targets& targets,
                  PassTimers& timers);
  Status share(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs, const Targets& targets,
               PassTimers& timers);
  Status blur(const FramePlan& plan, const CommandList& commands, const AoSettings& ao, const Targets& targets,
              PassTimers& timers);
  Status post(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs, const Targets& targets,
              PassTimers& timers);
  Status patterns(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs, const Targets& targets,
                  PassTimers& timers);
  void draw_layers(const CommandList& commands, const char* pass, PassTimers& timers);
  void draw_layers_of(const Batch& batch);
  // The same of pixels with a surface alone, for which the framebuffer knows the geometry's depth; the others have
  // none.
  void draw_occlusion(const CommandList& commands, const char* pass, PassTimers& timers, GLuint framebuffer);

  std::map<std::string, gl::Program> programs_;
  gl::VertexArray surface_array_, empty_array_;
  gl::Buffer frame_params_, ao_params_, ao_parameters_, ao_samples_, sharing_, patterns_;
};

// What the shaders read of a frame.
shared::FrameParams frame_params(const FrameInputs& inputs, int lights);

}  // namespace lfd
