// Draws all modules of one node: holds the state, submits frames, hands finished images out. One thread, that of the
// context.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/scene_data.h"
#include "proto/settings.h"
#include "rendernode/drawn_modules.h"
#include "rendernode/gl/context.h"
#include "rendernode/passes/frame_passes.h"
#include "rendernode/passes/readback.h"
#include "rendernode/plan/frame_plan.h"

namespace lfd {

// One finished buffer of one module. bytes: rows from the top; COLOR is RGBA8 with the sRGB transfer, or with the
// drives of the module's colour calibration; all others are RGBA float32.
struct ModuleImage {
  std::uint32_t module = 0;
  proto::BufferKind kind = proto::COLOR;
  ImageSize size;
  bool empty = false;  // the module sees no geometry: all background; no bytes
  std::shared_ptr<const std::string> bytes;
};

struct FrameOptions {
  BufferSet buffers;          // beside colour
  bool time_modules = false;  // times per module; costs one submission per module and pass
  bool reuse = true;          // may hand the last images out again where nothing has changed
  bool read_back = true;      // false: only draw (for timing)
};

struct FrameResult {
  std::vector<ModuleImage> images;
  Point3<World> position_origin;  // what POSITION buffers are counted from
  proto::NodeReport report;       // passes, what was left out, triangles; names are the caller's to fill in
};

class Renderer {
 public:
  // `context` is current on this thread and outlives the renderer; modules: numbers, each below display.modules.size(),
  // at most MODULES_PER_NODE of them.
  Renderer(const gl::Context& context, DisplayCalibration display, std::vector<std::uint32_t> modules);

  // Takes over scene, region of interest and settings; rebuilds only what they change. On an error the last state
  // stays.
  Status set_state(const proto::State& state, const Assets& assets);

  // Submits a frame; at most two may be under way. Errors: no state yet, no memory, pictures that GL
  // cannot draw into, a shader that does not compile.
  Status draw(const FrameOptions& options);

  // Frames submitted and not yet collected.
  int under_way() const { return under_way_; }

  // Whether the oldest frame under way is done on the GPU; waits at most so long.
  bool finished(Clock::duration at_most);

  // The oldest frame under way; waits for it.
  FrameResult collect();

  const DisplayCalibration& display() const { return display_; }
  const std::vector<std::uint32_t>& modules() const { return modules_; }
  const std::string& description() const { return description_; }
  const RegionOfInterest& roi() const { return roi_; }
  // The modules' maps as the GPU has them; there is a state.
  const WarpTables& tables() const { return own_->tables; }

 private:
  // One frame under way.
  struct Slot {
    Readback readback;
    PassTimers timers;
    FramePlan plan;
    FrameOptions options;
    RegionOfInterest roi;
    AoSettings ao;
    std::string occlusion_choice;
    bool reused = false;
    double geometry_ms = 0;
    double submit_ms = 0;
  };

  // What was chosen for these settings against their budget, and why.
  struct ChosenOcclusion {
    proto::AmbientOcclusion asked;
    AoSettings ao;
    std::string why;
  };

  Status rebuild(const proto::State& state, const Assets& assets);
  FramePlan plan(const FrameOptions& options) const;
  Result<FramePlan> submit(const FrameOptions& options, PassTimers& timers);
  // renderer_choice.cc: settings_.ao for a frame like this, where they are chosen by their budget
  Status choose_occlusion(const FrameOptions& options);
  Status time_candidates(const proto::AmbientOcclusion& asked, const FrameOptions& timed);
  Result<double> time_occlusion(const FrameOptions& timed);
  std::string why_nothing_is_seen() const;  // empty: something may be
  std::vector<ReadbackItem> wanted(const Slot& slot) const;
  std::vector<ModuleImage> images_of(const Slot& slot) const;
  void append_unchanged(const Slot& slot, std::vector<ModuleImage>& images) const;
  void append_empty(const Slot& slot, std::vector<ModuleImage>& images) const;
  void fill_report(Slot& slot, proto::NodeReport& report);

  DisplayCalibration display_;
  std::vector<std::uint32_t> modules_;
  std::string description_;
  bool is_software_;
  // As they are, and with the guard band that the settings ask for: null without one. rule_ refers to the larger ones.
  std::unique_ptr<const DrawnModules> own_, banded_;
  FramePasses passes_;
  Targets targets_;

  std::optional<proto::State> state_;
  RegionOfInterest roi_;
  RenderSettings settings_;
  DepthLimits limits_;
  std::unique_ptr<EdgeRule> rule_;
  MeshCache meshes_;
  PhysicalGeometry geometry_;
  GpuMaterials gpu_materials_;
  GpuGeometry gpu_geometry_;
  GpuLights gpu_lights_;
  double geometry_ms_ = 0;
  std::optional<ChosenOcclusion> chosen_;
  std::string occlusion_choice_;  // for the report of the next frame; empty without a budget

  std::array<Slot, 2> slots_;
  int next_slot_ = 0;
  int under_way_ = 0;
  // The last frame's images, and what they were drawn from, for frames in which nothing changes.
  std::vector<ModuleImage> last_images_;
  std::optional<BufferSet> drawn_buffers_;
  std::vector<std::string> drawn_inputs_;  // of the last frame that was read back, by layer; FramePlan::inputs
  std::string shared_inputs_;              // PlanInputs::shared of the state
  bool state_changed_ = true;
};

}  // namespace lfd
