// One frame read back, and each of its pixels against the reference.
#include "bench/frame/frame_error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "base/log.h"
#include "bench/common/frame_picture.h"
#include "bench/reference/method_limit.h"
#include "bench/reference/silhouette.h"
#include "rendernode/renderer.h"

namespace lfd::bench {
namespace {

// Indices of pixels with a surface in both pictures: a subset of the size that is asked for, or all.
std::vector<std::size_t> chosen_pixels(const reference::HitImage& hits, const PictureF& positions,
                                       const AoSubset& subset) {
  std::vector<std::size_t> in_both, chosen;
  for (std::size_t i = 0; i < hits.hit.size(); ++i) {
    if (hits.hit[i] && positions.rgba[4 * i + 3] > 0.5F) in_both.push_back(i);
  }
  std::mt19937_64 random(subset.seed);
  std::ranges::sample(in_both, std::back_inserter(chosen), subset.pixels, random);
  return chosen;
}

AoError ao_error(const reference::Intersector& intersector, const reference::ModuleView& view,
                 const reference::HitImage& hits, const std::vector<std::size_t>& pixels, const PictureF& rendered,
                 const AoSettings& settings, const AoSubset& subset) {
  AoError error{subset, pixels.size()};
  double sum = 0, sum_absolute = 0, sum_squares = 0;
  for (const std::size_t i : pixels) {
    // Each pixel has samples of its own, so that their errors do not add up.
    const reference::LimitEffort effort{.samples = subset.samples, .seed = subset.seed + i};
    const auto spot = reference::spot_of(view, intersector.scene(), *hits.hit[i]);
    const double limit = reference::curved_limit(intersector, view, spot, settings, effort);
    const double off = rendered.rgba[4 * i] - limit;
    sum += off;
    sum_absolute += std::abs(off);
    sum_squares += off * off;
  }
  if (pixels.empty()) return error;
  const auto count = static_cast<double>(pixels.size());
  error.mean_absolute = sum_absolute / count;
  error.mean_signed = sum / count;
  error.standard_error =
      std::sqrt(std::max(0.0, sum_squares / count - error.mean_absolute * error.mean_absolute) / count);
  return error;
}

}  // namespace

Result<FrameError> judge_frame(Renderer& renderer, const proto::State& state, const Assets& assets,
                               const AoSubset& subset) {
  LFD_CHECK(renderer.modules().size() == 1, "one module is judged");
  LFD_TRY_STATUS(renderer.set_state(state, assets));
  FrameOptions options;
  options.buffers.bits = 1U << proto::POSITION | 1U << proto::AO;
  options.reuse = false;
  LFD_TRY_STATUS(renderer.draw(options));
  const FrameResult frame = renderer.collect();
  const DisplayCalibration& display = renderer.display();
  const PictureF positions = picture_of(frame, proto::POSITION);

  LFD_TRY(const RenderSettings settings, read_settings(state.render()));
  const DepthLimits limits = depth_limits(display, settings);
  log::info("casting the lines of all pixels");
  LFD_TRY(const reference::WorldScene scene, reference::world_scene({state.scene(), assets}, renderer.roi()));
  const reference::Intersector intersector(scene);
  const reference::ModuleView view{display, display.modules[renderer.modules()[0]], {limits.front, limits.back}};
  const auto hits = reference::cast_module(intersector, view);
  FrameError error;
  error.position = reference::compare(hits, reference::near_silhouette(intersector, view, hits), positions,
                                      frame.position_origin, renderer.roi().diagonal_m());
  const auto pixels = chosen_pixels(hits, positions, subset);
  log::info("casting {} samples of ambient occlusion for each of {} pixels", subset.samples, pixels.size());
  error.ao = ao_error(intersector, view, hits, pixels, picture_of(frame, proto::AO), settings.ao, subset);
  return error;
}

}  // namespace lfd::bench
