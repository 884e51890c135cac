// Default settings, again and again.
#include "bench/ao/scaling.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/log.h"
#include "bench/ao/judge.h"
#include "bench/reference/ray_occlusion.h"

namespace lfd::bench {
namespace {

constexpr std::size_t kJudgedPixels = 4000;  // of each size

std::vector<Rung> default_rungs(const std::vector<Rung>& rungs) {
  std::vector<Rung> chosen;
  std::ranges::copy_if(rungs, std::back_inserter(chosen), &Rung::is_default);
  return chosen;
}

ScalingRow row_of(const Rung& rung, const Measurement& seen, double share, double radius_px, ImageSize image) {
  return {rung.method(), share, radius_px, image, spread_of(seen.occlusion_ms).median, spread_of(seen.ratio).median, 0};
}

// Openness by rays at pixels chosen at random, and -1 at the others.
Openness sampled_reference(const ShownScene& scene, std::uint32_t module, const reference::HitImage& hits,
                           double radius_m, int rays) {
  std::vector<std::size_t> with_surface, chosen;
  for (std::size_t i = 0; i < hits.hit.size(); ++i) {
    if (hits.hit[i]) with_surface.push_back(i);
  }
  std::mt19937_64 random(1);
  std::ranges::sample(with_surface, std::back_inserter(chosen), kJudgedPixels, random);
  Openness open{hits.size, std::vector<float>(hits.hit.size(), -1.0F)};
  for (const std::size_t i : chosen) {
    const auto spot = reference::spot_of(scene.view(module), scene.intersector().scene(), *hits.hit[i]);
    const auto found = reference::ray_occlusion(scene.intersector(), spot, {radius_m}, {rays, i});
    open.value[i] = static_cast<float>(1 - std::min(found.front().cosine, 1.0));
  }
  return open;
}

MeasureOptions measuring(const AoBenchOptions& options, double radius_m) {
  return {radius_m, options.frames, options.resume, options.out / "cache"};
}

// Mean milliseconds of one module in passes of occlusion, the median over frames.
Result<double> time_of(Renderer& renderer, const ShownScene& scene, const proto::AmbientOcclusion& ao, int frames) {
  LFD_TRY_STATUS(renderer.set_state(scene.state(ao), scene.assets()));
  std::vector<double> times;
  for (int frame = -1; frame < frames; ++frame) {  // the first is not counted: shaders are compiled
    LFD_TRY_STATUS(
        renderer.draw({.buffers = {1U << proto::AO}, .time_modules = false, .reuse = false, .read_back = false}));
    const FrameResult drawn = renderer.collect();
    double sum_ms = 0;
    for (const proto::PassTime& pass : drawn.report.pass())
      sum_ms += is_occlusion_pass(pass.pass()) ? pass.gpu_ms() : 0;
    if (frame >= 0) times.push_back(sum_ms / static_cast<double>(renderer.modules().size()));
  }
  return spread_of(times).median;
}

}  // namespace

const std::vector<double>& scaling_radii() {
  static const std::vector<double> kShares{0.02, 0.04, 0.08, 0.16};
  return kShares;
}

Result<std::vector<ScalingRow>> scale_radius(const ScalingInputs& in, const ReferencePicture& reference) {
  const std::vector<Rung> rungs = default_rungs(in.rungs);
  PlaceRenderers renderers(in.context, in.scene, in.module);
  const auto hits = reference::cast_module(in.scene.intersector(), in.scene.view(in.module));
  std::vector<ScalingRow> rows;
  for (const double share : scaling_radii()) {
    log::info("radius {} of the diagonal: default settings", share);
    const double radius_m = share * in.scene.roi().diagonal_m();
    const auto k = std::ranges::find(reference.radius_m, radius_m) - reference.radius_m.begin();
    const Openness& open = reference.cosine[static_cast<std::size_t>(k)];
    LFD_TRY(const auto seen, measure(renderers, in.scene, in.module, rungs, measuring(in.options, radius_m)));
    const double px = mean_length_px(in.scene, in.module, hits, radius_m);
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      rows.push_back(row_of(rungs[i], seen[i], share, px, in.scene.display().image));
      rows.back().mae = difference(open, curved(seen[i].open, curve_of(rungs[i]))).mae;
    }
  }
  return rows;
}

Result<std::vector<ScalingRow>> scale_size(const ScalingInputs& in, double share) {
  const std::vector<Rung> rungs = default_rungs(in.rungs);
  std::vector<ScalingRow> rows;
  for (const ImageSize size : in.options.sizes) {
    log::info("images of {}x{}: default settings", size.width, size.height);
    LFD_TRY(const auto scene, in.scene.of_size(size));
    PlaceRenderers renderers(in.context, *scene, in.module);
    const double radius_m = share * scene->roi().diagonal_m();
    const auto hits = reference::cast_module(scene->intersector(), scene->view(in.module));
    const Openness open = sampled_reference(*scene, in.module, hits, radius_m, in.options.rays);
    LFD_TRY(const auto seen, measure(renderers, *scene, in.module, rungs, measuring(in.options, radius_m)));
    const double px = mean_length_px(*scene, in.module, hits, radius_m);
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      rows.push_back(row_of(rungs[i], seen[i], share, px, size));
      rows.back().mae = difference(open, curved(seen[i].open, curve_of(rungs[i]))).mae;
    }
  }
  return rows;
}

Result<std::vector<SharingRow>> scale_modules(const ScalingInputs& in, double share) {
  proto::AmbientOcclusion alone;
  alone.set_enabled(true);
  alone.set_method("march");
  alone.set_samples(4);
  alone.set_radius_m(share * in.scene.roi().diagonal_m());
  proto::AmbientOcclusion shared = alone;
  shared.mutable_shared()->set_neighbours(4);
  const int count = static_cast<int>(in.scene.display().modules.size());
  std::vector<SharingRow> rows;
  for (const int modules : in.options.module_counts) {
    if (modules > count) continue;
    log::info("{} modules: sharing", modules);
    std::vector<std::uint32_t> numbers;
    for (int i = 0; i < modules; ++i) numbers.push_back(static_cast<std::uint32_t>((count - modules) / 2 + i));
    Renderer renderer(in.context, in.scene.display(), numbers);
    SharingRow row{modules, 0, 0};
    LFD_TRY(row.alone_ms, time_of(renderer, in.scene, alone, in.options.frames));
    LFD_TRY(row.shared_ms, time_of(renderer, in.scene, shared, in.options.frames));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lfd::bench
