// Pictures of the stability suite: drawn on the GPU, held against the reference caster, searched for numbers that are
// not finite.
#pragma once

#include <optional>
#include <vector>

#include "bench/reference/truth.h"
#include "bench/stability/case.h"
#include "bench/stability/color_truth.h"
#include "bench/stability/picture_bounds.h"
#include "calibration/display.h"
#include "calibration/spaces/roi.h"
#include "proto/scene_data.h"
#include "proto/settings.pb.h"

namespace lfd::bench {

// What is drawn: module 0 of the display.
struct Drawing {
  DisplayCalibration display;
  SceneData data;
  RegionOfInterest roi;
  proto::RenderSettings settings;
  // The same surfaces, as far as they can be seen, for the reference: it takes no triangles that are not finite, and
  // its double precision ends where theirs are 1e20 m large. Absent: `data` itself.
  std::optional<SceneData> seen = std::nullopt;
};

struct Drawn {
  FrameResult frame;
  reference::Truth truth;  // of the positions, over the ROI diagonal
  ColorTruth color;
  std::string fault;  // empty, or the buffer that has a number that is not finite, or GL's complaint
};

// Draws colour, position, normal, ambient occlusion and depth, in the light that the controller gives a scene without
// lights. Errors: those of the renderer, by name.
Result<Drawn> draw(const gl::Context& context, const Drawing& drawing);

// Passes where positions are within the bounds, colours within kColorTolerance, and no buffer has a number that is not
// finite. `make` makes the drawing when the case runs.
StabilityCase drawn_true(std::string group, std::string name, std::function<Drawing()> make,
                         const PictureBounds& bounds = {});

// Passes where something is drawn and no buffer has a number that is not finite: of maps that no picture is true for.
StabilityCase drawn_finite(std::string group, std::string name, std::function<Drawing()> make);

// Passes where the renderer refuses with these words.
StabilityCase drawing_refused(std::string group, std::string name, const std::string& words,
                              std::function<Drawing()> make);

// 0.4 x 0.3 m, 128 x 96 pixels, one ideal module to the left, observers at 0.8 m.
DisplayCalibration small_display(Diffuser diffuser = Diffuser::kLinear);

// A box of 0.36 x 0.27 x 0.3 m about the screen's centre, in the world and in physical space.
RegionOfInterest small_roi();

// A sphere before a wall on a floor, of one coloured material, made in the unit cube about the origin and placed so
// that it fills the world box.
SceneData sphere_in_box(const RegionOfInterest& roi);

}  // namespace lfd::bench
