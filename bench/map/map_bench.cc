// Every variant's renderer side by side, a frame of each in turn.
#include "bench/map/map_bench.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/clock.h"
#include "base/log.h"
#include "bench/common/built_commit.h"
#include "bench/common/frame_picture.h"
#include "bench/common/shown_scene.h"
#include "bench/common/spread.h"
#include "bench/reference/silhouette.h"
#include "rendernode/renderer.h"

namespace lfd::bench {
namespace {

constexpr FrameOptions kOnlyDraw{.buffers = {}, .time_modules = false, .reuse = false, .read_back = false};
constexpr int kWarmUpFrames = 1;  // shaders are compiled, targets made

// One variant while it is timed.
struct Candidate {
  MapVariant variant;
  std::unique_ptr<Renderer> renderer;
  MapRow row;
  std::vector<double> gpu_ms, wall_ms;
};

Result<proto::State> state_of(const Deployment& deployment, const proto::Scene& scene, const MapVariant& variant) {
  LFD_TRY(const RegionOfInterest roi, complete_roi(deployment.message.roi(), scene, deployment.display.screen));
  proto::State state;
  state.set_sequence(1);
  *state.mutable_scene() = scene;
  *state.mutable_roi() = write_roi(roi);
  *state.mutable_render() = deployment.message.render();
  state.mutable_render()->MergeFrom(variant.render);
  state.mutable_render()->mutable_ao()->set_enabled(false);
  state.set_buffers(1U << proto::POSITION);
  return state;
}

Status draw_one(Candidate& candidate, bool counts) {
  const auto start = Clock::now();
  FrameOptions options = kOnlyDraw;
  options.buffers.bits = 1U << proto::POSITION;
  LFD_TRY_STATUS(candidate.renderer->draw(options));
  const FrameResult frame = candidate.renderer->collect();
  const double wall_ms = milliseconds(Clock::now() - start);
  if (!counts) return {};
  double gpu_ms = 0;
  for (const proto::PassTime& pass : frame.report.pass()) {
    if (pass.pass() == "z_prepass" || pass.pass() == "gbuffer") gpu_ms += pass.gpu_ms();
  }
  candidate.gpu_ms.push_back(gpu_ms);
  candidate.wall_ms.push_back(wall_ms);
  return {};
}

// What the modules must show, cast once for all variants.
struct Expected {
  reference::HitImage hits;
  std::vector<std::uint8_t> near_silhouette;
};

Result<Expected> cast(const proto::State& state, const Assets& assets, const DisplayCalibration& display,
                      std::uint32_t module, const RegionOfInterest& roi) {
  LFD_TRY(const RenderSettings settings, read_settings(state.render()));
  const DepthLimits limits = depth_limits(display, settings);
  LFD_TRY(const reference::WorldScene scene, reference::world_scene({state.scene(), assets}, roi));
  const reference::Intersector intersector(scene);
  const reference::ModuleView view{display, display.modules[module], {limits.front, limits.back}};
  Expected expected{reference::cast_module(intersector, view), {}};
  expected.near_silhouette = reference::near_silhouette(intersector, view, expected.hits);
  return expected;
}

Status judge(Candidate& candidate, const Expected& expected) {
  FrameOptions options;
  options.buffers.bits = 1U << proto::POSITION;
  options.reuse = false;
  LFD_TRY_STATUS(candidate.renderer->draw(options));
  const FrameResult frame = candidate.renderer->collect();
  candidate.row.truth = reference::compare(expected.hits, expected.near_silhouette, picture_of(frame, proto::POSITION),
                                           frame.position_origin, candidate.renderer->roi().diagonal_m());
  candidate.row.triangles = frame.report.triangles();
  return {};
}

Result<std::vector<Candidate>> candidates_of(const gl::Context& context, const Deployment& deployment,
                                             const LoadedScene& scene, std::uint32_t module) {
  std::vector<Candidate> candidates;
  for (const MapVariant& variant : map_variants(deployment.display)) {
    Candidate one{variant, std::make_unique<Renderer>(context, deployment.display, std::vector{module}), {}, {}, {}};
    LFD_TRY(const proto::State state, state_of(deployment, scene.data.scene, variant));
    const auto start = Clock::now();
    LFD_TRY_STATUS(one.renderer->set_state(state, scene.data.assets));
    one.row.scene = shown_scene_name(deployment);
    one.row.variant = variant.name;
    one.row.module = module;
    one.row.build_ms = milliseconds(Clock::now() - start);
    const WarpTables& tables = one.renderer->tables();
    if (tables.of_module[0]) one.row.table = MeasuredTable{tables.columns(), tables.of_module[0]->error_px};
    candidates.push_back(std::move(one));
  }
  return candidates;
}

void summarise(std::vector<Candidate>& candidates) {
  const Candidate& plain = candidates.front();
  for (Candidate& one : candidates) {
    std::vector<double> gpu_ratio, wall_ratio;
    for (std::size_t i = 0; i < one.wall_ms.size(); ++i) {
      gpu_ratio.push_back(one.gpu_ms[i] / plain.gpu_ms[i]);
      wall_ratio.push_back(one.wall_ms[i] / plain.wall_ms[i]);
    }
    one.row.gpu_ms = spread_of(one.gpu_ms);
    one.row.wall_ms = spread_of(one.wall_ms);
    one.row.gpu_ratio = spread_of(gpu_ratio);
    one.row.wall_ratio = spread_of(wall_ratio);
  }
}

Result<std::vector<std::uint32_t>> chosen_modules(const MapBenchOptions& options, const DisplayCalibration& display) {
  const auto count = static_cast<std::uint32_t>(display.modules.size());
  for (const std::uint32_t module : options.modules) {
    if (module >= count) return Error(fmt::format("module {}: the display has {}", module, count));
  }
  if (!options.modules.empty()) return options.modules;
  std::vector<std::uint32_t> modules{count / 2};
  for (const std::uint32_t outermost : {0U, count - 1}) {
    if (std::ranges::find(modules, outermost) == modules.end()) modules.push_back(outermost);
  }
  return modules;
}

// All variants on one module: timed side by side, then judged.
Result<std::vector<MapRow>> rows_of(const gl::Context& context, const Deployment& deployment, const LoadedScene& scene,
                                    std::uint32_t module, int frames) {
  const std::string name = fmt::format("{}, module {}", shown_scene_name(deployment), module);
  log::info("{}: building", name);
  LFD_TRY(std::vector<Candidate> candidates, candidates_of(context, deployment, scene, module));
  const RegionOfInterest roi = candidates.front().renderer->roi();
  for (int frame = -kWarmUpFrames; frame < frames; ++frame) {
    for (Candidate& one : candidates) LFD_TRY_STATUS(draw_one(one, frame >= 0));
    if (frame >= 0) log::info("{}: round {} of {}", name, frame + 1, frames);
  }
  summarise(candidates);
  log::info("{}: casting the lines of all pixels", name);
  LFD_TRY(const proto::State state, state_of(deployment, scene.data.scene, candidates.front().variant));
  LFD_TRY(const Expected expected, cast(state, scene.data.assets, deployment.display, module, roi));
  std::vector<MapRow> rows;
  for (Candidate& one : candidates) {
    LFD_TRY_STATUS(judge(one, expected));
    one.row.roi_diagonal_m = roi.diagonal_m();
    rows.push_back(one.row);
  }
  return rows;
}

}  // namespace

std::vector<std::string> MapTable::scenes() const {
  std::vector<std::string> names;
  for (const MapRow& row : rows) {
    if (std::ranges::find(names, row.scene) == names.end()) names.push_back(row.scene);
  }
  return names;
}

const Spread& cost_ratio(const MapTable& table, const MapRow& row) {
  return table.is_software ? row.wall_ratio : row.gpu_ratio;
}

std::vector<std::string> missed_bounds(const reference::Truth& truth, const MapBounds& bounds) {
  std::vector<std::string> missed;
  const auto check = [&](const char* what, double value, double bound) {
    if (value <= bound) return;
    missed.push_back(fmt::format("{} {:.2g}; at most {:.2g} is allowed", what, value, bound));
  };
  check("99.9 % error", truth.percent_999, bounds.percent_999);
  check("largest error", truth.max, bounds.max);
  check("coverage mismatch", truth.mismatch_share, bounds.mismatch_share);
  return missed;
}

std::vector<std::string> missed_bounds(const MapTable& table, const std::string& variant, const MapBounds& bounds) {
  std::vector<std::string> missed;
  for (const MapRow& row : table.rows) {
    if (row.variant != variant) continue;
    std::vector<std::string> of_row = missed_bounds(row.truth, bounds);
    const double ratio = cost_ratio(table, row).median;
    if (row.scene == table.rows.front().scene && ratio > bounds.ratio)
      of_row.push_back(fmt::format("time over plain vertices {:.2f}; at most {:.2f} is allowed", ratio, bounds.ratio));
    for (const std::string& line : of_row)
      missed.push_back(fmt::format("{}, module {}: {}", row.scene, row.module, line));
  }
  return missed;
}

Result<MapTable> map_bench(const gl::Context& context, const MapBenchOptions& options) {
  if (options.frames < 1) return Error(fmt::format("frames: {}; at least 1 is needed", options.frames));
  // All files are read before anything is timed.
  std::vector<Deployment> deployments;
  DeploymentOverrides overrides = options.overrides;
  for (std::size_t i = 0; i < std::max<std::size_t>(options.scenes.size(), 1); ++i) {
    if (!options.scenes.empty()) overrides.scene = options.scenes[i];
    LFD_TRY(Deployment deployment, load_deployment(options.deployment, overrides));
    deployments.push_back(std::move(deployment));
  }
  const DisplayCalibration& display = deployments.front().display;
  LFD_TRY(const std::vector<std::uint32_t> modules, chosen_modules(options, display));
  MapTable table{
      display.name, display.image, context.description(), context.is_software(), built_version(), options.frames, {}};
  for (const Deployment& deployment : deployments) {
    LFD_TRY(const LoadedScene scene, load_shown_scene(deployment));
    for (const std::uint32_t module : modules) {
      LFD_TRY(const std::vector<MapRow> rows, rows_of(context, deployment, scene, module, options.frames));
      table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    }
  }
  return table;
}

Result<MapTable> map_bench(const MapBenchOptions& options) {
  LFD_TRY(const std::unique_ptr<gl::Context> context, gl::Context::create(options.gpu));
  return map_bench(*context, options);
}

}  // namespace lfd::bench
