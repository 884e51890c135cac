// All modules of a node before one scene, with what the renderer keeps to itself: ambient occlusion before and after it
// is shared.
#pragma once

#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "rendernode/geometry/edge_rule.h"
#include "rendernode/passes/frame_passes.h"
#include "tests/support/rendering.h"

namespace lfd::testing_support {

// Buffers of one layer: positions minus ROI centre (w 1 where there is a surface), normals, ambient occlusion (-1
// without).
struct LayerPicture {
  std::vector<glm::vec4> position, normal;
  std::vector<float> ao;
};

class SharingStage {
 public:
  SharingStage(SceneData data, const RegionOfInterest& roi, DisplayCalibration display,
               std::vector<std::uint32_t> modules)
      : data_(std::move(data)), roi_(roi), display_(std::move(display)), modules_(std::move(modules)) {}

  const DisplayCalibration& display() const { return display_; }
  const RegionOfInterest& roi() const { return roi_; }
  const std::vector<std::uint32_t>& modules() const { return modules_; }
  const ModuleCalibration& module(std::size_t layer) const { return display_.modules[modules_[layer]]; }

  // Without blur. `gather`: false leaves out the pass that gathers; samples and noise are the same. `has_radius`: false
  // sets it to 0, which no message can.
  std::vector<LayerPicture> draw(const proto::AmbientOcclusion& ao, bool gather, bool has_radius = true) {
    context();
    proto::RenderSettings message;
    *message.mutable_ao() = ao;
    message.mutable_ao()->mutable_blur()->set_enabled(false);
    RenderSettings settings = *read_settings(message);
    if (!has_radius) settings.ao.radius_m = settings.ao.radius_roi = 0;
    const WarpTables tables = warp_tables(display_, modules_, 0);
    const GpuModules gpu_modules = upload_modules(display_, modules_, tables, {0, display_.screen});
    const DepthLimits limits = depth_limits(display_, settings);
    const EdgeRule rule(display_, modules_, tables, limits, settings.subdivision_px);
    MeshCache meshes;
    const PhysicalGeometry geometry = *build_geometry(data_.scene, data_.assets, meshes, roi_, limits, rule);
    const GpuGeometry gpu_geometry = upload_geometry(geometry);
    const GpuMaterials materials = *upload_materials(data_.scene, data_.assets, false);
    const GpuLights lights = upload_lights(data_.scene, roi_);
    FramePlan plan = plan_frame({&display_, &modules_, &geometry.items, &materials.facts, lights.facts, settings,
                                 buffers({proto::POSITION, proto::NORMAL, proto::AO}), "", nullptr, true});
    plan.share = plan.share && gather;
    Targets targets(display_.image, static_cast<int>(modules_.size()));
    PassTimers timers;
    FramePasses passes;
    const Status drawn = passes.submit(plan, make_commands(plan, geometry.items, materials.facts, false),
                                       {gpu_modules, materials, gpu_geometry, lights, roi_, settings, limits, display_},
                                       targets, timers);
    LFD_CHECK(drawn, drawn.error().message());
    return read(plan, targets);
  }

 private:
  // Layers that are not drawn hold nothing.
  std::vector<LayerPicture> read(const FramePlan& plan, const Targets& targets) const {
    const std::size_t pixels = static_cast<std::size_t>(display_.image.width) * display_.image.height;
    std::vector<glm::vec4> position(pixels * modules_.size()), normal(position.size());
    std::vector<float> ao(position.size());
    const auto bytes = [](const auto& texels) { return static_cast<GLsizei>(texels.size() * sizeof(texels[0])); };
    glGetTextureImage(targets.position(), 0, GL_RGBA, GL_FLOAT, bytes(position), position.data());
    glGetTextureImage(targets.normal(), 0, GL_RGBA, GL_FLOAT, bytes(normal), normal.data());
    glGetTextureImage(targets.ao(0), 0, GL_RED, GL_FLOAT, bytes(ao), ao.data());
    std::vector<LayerPicture> pictures(modules_.size());
    for (const std::uint32_t layer : plan.active_layers) {
      const auto part = [&](const auto& all) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(pixels * layer);
        return std::vector(first, first + static_cast<std::ptrdiff_t>(pixels));
      };
      pictures[layer] = {part(position), part(normal), part(ao)};
    }
    return pictures;
  }

  SceneData data_;
  RegionOfInterest roi_;
  DisplayCalibration display_;
  std::vector<std::uint32_t> modules_;
};

}  // namespace lfd::testing_support
