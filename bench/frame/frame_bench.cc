// From a deployment file to the table of its middle module.
#include "bench/frame/frame_bench.h"

#include <utility>

#include "base/log.h"
#include "base/version.h"
#include "bench/common/built_commit.h"
#include "bench/common/shown_scene.h"
#include "controller/scene/scene_file.h"
#include "rendernode/renderer.h"

namespace lfd::bench {
namespace {

// The scene at rest, whole or as the region of interest says, with ambient occlusion; the planner is on.
Result<proto::State> state_of(const Deployment& deployment, const FrameBenchOptions& options,
                              const proto::Scene& scene) {
  LFD_TRY(const RegionOfInterest roi,
          complete_roi(options.roi.value_or(deployment.message.roi()), scene, deployment.display.screen));
  proto::State state;
  state.set_sequence(1);
  *state.mutable_scene() = scene;
  *state.mutable_roi() = write_roi(roi);
  *state.mutable_render() = deployment.message.render();
  state.mutable_render()->set_planner(proto::RenderSettings::PLAN);
  state.mutable_render()->mutable_ao()->set_enabled(true);
  return state;
}

Result<std::uint32_t> chosen_module(const FrameBenchOptions& options, const DisplayCalibration& display) {
  const auto count = static_cast<std::uint32_t>(display.modules.size());
  const std::uint32_t module = options.module.value_or(count / 2);
  if (module < count) return module;
  return Error(fmt::format("module {}: display \"{}\" has modules 0 to {}", module, display.name, count - 1));
}

// What is known of the subject before anything is timed; the first frame tells the rest.
Result<FrameSubject> subject_of(const Deployment& deployment, const SceneData& scene, const Renderer& renderer,
                                const proto::State& state) {
  LFD_TRY(const scene::Census census, scene::census_of(scene));
  LFD_TRY(const RenderSettings settings, read_settings(state.render()));
  FrameSubject subject;
  subject.scene = shown_scene_name(deployment);
  subject.faces = census.faces;
  subject.textures = census.pictures;
  subject.display = deployment.display.name;
  subject.module = renderer.modules()[0];
  subject.modules = static_cast<std::uint32_t>(deployment.display.modules.size());
  subject.image = deployment.display.image;
  subject.roi_diagonal_m = renderer.roi().diagonal_m();
  subject.ao_radius_m = settings.ao.radius_in_world_m(subject.roi_diagonal_m);
  subject.ao = settings.ao;
  subject.version = kVersion;
  subject.commit = built_commit();
  return subject;
}

// Draws one frame only to hear what the renderer has to say of itself.
Status ask_renderer(Renderer& renderer, FrameSubject& subject) {
  LFD_TRY_STATUS(renderer.draw({.buffers = {}, .time_modules = false, .reuse = false, .read_back = false}));
  const proto::NodeReport report = renderer.collect().report;
  subject.renderer = report.renderer();
  subject.drawn_triangles = report.triangles();
  for (const proto::PassTime& pass : report.pass()) {
    if (pass.pass() == "geometry") subject.geometry_build_ms = pass.cpu_ms();
  }
  return {};
}

}  // namespace

Status check_options(const FrameBenchOptions& options) {
  LFD_TRY_STATUS(gl::check_gpu(options.gpu));
  const auto deployment = load_deployment(options.deployment, options.overrides);
  if (!deployment) return {};
  if (const auto module = chosen_module(options, deployment->display); !module) return module.error();
  return {};
}

Result<FrameTable> frame_bench(const gl::Context& context, const FrameBenchOptions& options) {
  if (options.frames < 1) return Error(fmt::format("frames: {}; at least 1 is needed", options.frames));
  LFD_TRY(const Deployment deployment, load_deployment(options.deployment, options.overrides));
  LFD_TRY(const std::uint32_t module, chosen_module(options, deployment.display));
  log::info("loading {}", shown_scene_name(deployment));
  LFD_TRY(const LoadedScene loaded, load_shown_scene(deployment));
  for (const std::string& warning : loaded.warnings) log::warn("{}", warning);
  LFD_TRY(const proto::State state, state_of(deployment, options, loaded.data.scene));
  Renderer renderer(context, deployment.display, {module});
  LFD_TRY_STATUS(renderer.set_state(state, loaded.data.assets));

  LFD_TRY(FrameSubject subject, subject_of(deployment, loaded.data, renderer, state));
  LFD_TRY_STATUS(ask_renderer(renderer, subject));
  log::info("drawing {} frames without and with ambient occlusion", options.frames);
  LFD_TRY(PassTimes times, time_passes(renderer, state, loaded.data.assets, options.frames));
  LFD_TRY(FrameError error, judge_frame(renderer, state, loaded.data.assets, options.ao_subset));
  return FrameTable{std::move(subject), std::move(times), std::move(error)};
}

Result<FrameTable> frame_bench(const FrameBenchOptions& options) {
  LFD_TRY(const std::unique_ptr<gl::Context> context, gl::Context::create(options.gpu));
  return frame_bench(*context, options);
}

}  // namespace lfd::bench
