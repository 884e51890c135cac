// Drawing and judging.
#include "bench/stability/drawing.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "bench/common/frame_picture.h"
#include "bench/reference/scene_maker.h"
#include "bench/reference/silhouette.h"
#include "bench/stability/frame_fault.h"
#include "rendernode/renderer.h"

namespace lfd::bench {
namespace {

void add_light(proto::Scene& scene, proto::Light::Kind kind, float level) {
  proto::Light& light = *scene.add_light();
  light.set_kind(kind);
  for (int channel = 0; channel < 3; ++channel) light.add_color(level);
}

proto::State state_of(const Drawing& drawing) {
  proto::State state;
  state.set_sequence(1);
  *state.mutable_scene() = drawing.data.scene;
  add_light(*state.mutable_scene(), proto::Light::AMBIENT, 0.3F);
  add_light(*state.mutable_scene(), proto::Light::HEAD, 0.7F);
  *state.mutable_roi() = write_roi(drawing.roi);
  *state.mutable_render() = drawing.settings;
  return state;
}

Result<reference::Truth> truth_of(const Drawing& drawing, const RenderSettings& settings, const FrameResult& frame) {
  LFD_TRY(const reference::WorldScene scene, reference::world_scene(drawing.seen.value_or(drawing.data), drawing.roi));
  const reference::Intersector intersector(scene);
  const DepthLimits limits = depth_limits(drawing.display, settings);
  const reference::ModuleView view{drawing.display, drawing.display.modules[0], {limits.front, limits.back}};
  const auto hits = reference::cast_module(intersector, view);
  const auto near_silhouette = reference::near_silhouette(intersector, view, hits);
  return reference::compare(hits, near_silhouette, picture_of(frame, proto::POSITION), frame.position_origin,
                            drawing.roi.diagonal_m());
}

}  // namespace

Result<Drawn> draw(const gl::Context& context, const Drawing& drawing) {
  LFD_TRY_STATUS(validate(drawing.display));
  const int errors_before = gl::Context::error_count();
  Renderer renderer(context, drawing.display, {0});
  const proto::State state = state_of(drawing);
  LFD_TRY_STATUS(renderer.set_state(state, drawing.data.assets));
  BufferSet buffers;
  for (const auto kind : {proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH}) buffers.bits |= 1U << kind;
  LFD_TRY_STATUS(renderer.draw({.buffers = buffers}));
  Drawn drawn;
  drawn.frame = renderer.collect();
  LFD_TRY(const RenderSettings settings, read_settings(drawing.settings));
  LFD_TRY(drawn.truth, truth_of(drawing, settings, drawn.frame));
  drawn.color = compare_colors(drawing.display, state.scene(), drawing.roi, settings, drawn.frame);
  drawn.fault = fault_of(drawn.frame);
  if (gl::Context::error_count() != errors_before) drawn.fault += "GL reported an error";
  return drawn;
}

StabilityCase drawn_true(std::string group, std::string name, std::function<Drawing()> make,
                         const PictureBounds& bounds) {
  return {std::move(group), std::move(name), text_of(bounds),
          [make = std::move(make), bounds](const gl::Context& context) -> Outcome {
            const auto drawn = draw(context, make());
            if (!drawn) return {"error: " + drawn.error().message(), 0, false};
            const reference::Truth& truth = drawn->truth;
            std::string got =
                fmt::format("{:.1e}, {:.1e}, {:.1e} on {} pixels; {:.2g}; {}", truth.median, truth.percent_999,
                            truth.max, truth.compared, truth.mismatch_share, drawn->color.worst);
            std::vector<std::string> broken = broken_bounds(truth, bounds);
            if (!drawn->fault.empty()) broken.push_back(drawn->fault);
            if (drawn->color.worst > kColorTolerance) broken.push_back(drawn->color.where);
            for (const std::string& one : broken) got += "; " + one;
            return {got, truth.max, broken.empty()};
          }};
}

StabilityCase drawn_finite(std::string group, std::string name, std::function<Drawing()> make) {
  return {std::move(group), std::move(name), "something is drawn; all finite",
          [make = std::move(make)](const gl::Context& context) -> Outcome {
            const auto drawn = draw(context, make());
            if (!drawn) return {"error: " + drawn.error().message(), 0, false};
            const std::size_t pixels = drawn->truth.in_both + drawn->truth.only_in_rendered;
            const bool passed = drawn->fault.empty() && pixels > 0;
            return {fmt::format("{} pixels with a surface{}{}", pixels, passed ? "" : "; ", drawn->fault), 0, passed};
          }};
}

StabilityCase drawing_refused(std::string group, std::string name, const std::string& words,
                              std::function<Drawing()> make) {
  return {std::move(group), std::move(name), fmt::format("error: \"{}\"", words),
          [words, make = std::move(make)](const gl::Context& context) -> Outcome {
            const auto drawn = draw(context, make());
            if (drawn) return {"no error", 0, false};
            return {"error: " + drawn.error().message(), 0, drawn.error().message().find(words) != std::string::npos};
          }};
}

DisplayCalibration small_display(Diffuser diffuser) {
  DisplayCalibration display{"small", {0.4, 0.3}, {128, 96}, {diffuser, 0.05, 0.8, 0, false}, 0.05, {}};
  display.modules.push_back({{-0.1, -0.08, -0.6}, IdealMap{}});
  return display;
}

RegionOfInterest small_roi() {
  RegionOfInterest roi;
  roi.world_size = roi.physical_size = {0.36, 0.27, 0.3};
  return roi;
}

SceneData sphere_in_box(const RegionOfInterest& roi) {
  reference::SceneMaker maker;
  const auto plain = maker.add_material({.base_color = {0.8F, 0.5F, 0.2F, 1}});
  const glm::dmat3 axes = glm::mat3_cast(roi.world_orientation);
  std::array<double, 12> placement{};
  for (std::size_t row = 0; row < 3; ++row) {
    const auto i = static_cast<int>(row);
    for (int column = 0; column < 3; ++column)
      placement[4 * row + static_cast<std::size_t>(column)] = axes[column][i] * roi.world_size[column];
    placement[4 * row + 3] = to_glm(roi.world_centre)[i];
  }
  maker.add_mesh(reference::sphere({0.1F, 0, 0.1F}, 0.3F, 16), plain, placement);
  MeshArrays quads;
  quads.position = {{-0.5F, -0.5F, -0.4F}, {0.5F, -0.5F, -0.4F}, {0.5F, 0.5F, -0.4F},  {-0.5F, 0.5F, -0.4F},
                    {-0.5F, -0.4F, 0.45F}, {0.5F, -0.4F, 0.45F}, {0.5F, -0.4F, -0.5F}, {-0.5F, -0.4F, -0.5F}};
  quads.normal.assign(4, {0, 0, 1});
  quads.normal.resize(8, {0, 1, 0});
  quads.index = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  maker.add_mesh(quads, plain, placement);
  return maker.data();
}

}  // namespace lfd::bench
