// Decides what a frame needs: which modules, draws, passes and targets, and why the others are left out.
//
// A module with a colour calibration is always drawn: what it must be fed to show the background differs from pixel to
// pixel.
//
// It knows no GL: it is told the scene's items, the settings and what is asked for, and returns lists. Told to plan
// everything, it leaves nothing out; the pictures are the same (a test holds that). Where a test pattern is shown there
// is no picture that anything else could be left out of.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibration/display.h"
#include "proto/settings.h"
#include "proto/wire.pb.h"
#include "rendernode/geometry/physical_geometry.h"
#include "rendernode/plan/sharing.h"

namespace lfd {

// Kinds of buffers asked for beside colour, by proto::BufferKind.
struct BufferSet {
  std::uint32_t bits = 0;
  bool has(proto::BufferKind kind) const { return (bits >> kind & 1U) != 0; }
  bool operator==(const BufferSet&) const = default;
};

// What a plan has to know of a material.
struct MaterialFacts {
  int texture_group = -1;  // which array texture holds its picture; -1: none
  bool alpha_mask = false;
  bool unlit = false;
  bool double_sided = false;
  bool operator==(const MaterialFacts&) const = default;
};

// What a plan has to know of the lights.
struct LightFacts {
  bool need_normal = false;    // any but ambient light
  bool need_position = false;  // point and spot lights
};

struct PlanInputs {
  const DisplayCalibration* display = nullptr;
  const std::vector<std::uint32_t>* modules = nullptr;  // module number of each layer
  const std::vector<GeometryItem>* items = nullptr;
  const std::vector<MaterialFacts>* materials = nullptr;
  LightFacts lights;
  RenderSettings settings;
  BufferSet buffers;
  // A hash of what every module's picture depends on: region of interest, settings, materials, lights.
  std::string shared = {};
  const std::vector<std::string>* drawn = nullptr;  // FramePlan::inputs of the images in hand; null: there are none
  bool is_software = false;                         // a rasteriser on the CPU draws
  const DisplayCalibration* banded = nullptr;       // the display with a guard band; null: there is none
};

// Draws that one shader variant with one set of textures can make in one submission.
struct DrawGroup {
  int texture_group = -1;
  bool alpha_mask = false;
  struct Draw {
    std::uint32_t item = 0, layer = 0;
    bool operator==(const Draw&) const = default;
  };
  std::vector<Draw> draws;
};

struct FramePlan {
  std::vector<DrawGroup> groups;
  std::vector<std::uint32_t> active_layers;     // layers that anything is drawn into
  std::vector<std::uint32_t> unchanged_layers;  // layers whose images in hand are still true
  std::vector<std::string> inputs;              // of each layer: a hash of all that its picture depends on
  bool z_prepass = true, position = true, normal = true, ao = true, blur = true, post = true;
  bool upsample = false;   // ambient occlusion is of half the resolution
  bool share = false;      // every module gathers what its neighbours found
  Sharing sharing;         // among layers that see geometry, where the settings ask for it
  bool bent = false;       // it finds mean open directions too
  int pyramid_levels = 0;  // of positions, beside the full picture; 0: the method reads none
  int pyramid_factor = 0;  // how many times smaller each is than the one before
  int guard_band_px = 0;   // geometry is drawn so far beside the images, for ambient occlusion
  bool color = false;      // the post pass corrects colours: a module of the node has a colour calibration
  bool pattern = false;    // test patterns are drawn in place of all this
  std::vector<std::uint32_t> pattern_layers;  // that show them; the other layers are black
  std::vector<proto::LeftOut> left_out;
};

FramePlan plan_frame(const PlanInputs& inputs);

// Whether anything within the bounds may have an image in the module: never false where it has one.
bool may_be_seen(const DisplayCalibration& display, const ModuleCalibration& module, Point3<Physical> low,
                 Point3<Physical> high);

}  // namespace lfd
