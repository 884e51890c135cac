// Frames in turn.
#include "bench/ao/measure.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "base/log.h"
#include "bench/ao/kept_measurements.h"
#include "bench/common/frame_picture.h"

namespace lfd::bench {
namespace {

struct PassSums {
  double occlusion_ms = 0, blur_ms = 0;  // of one module
};

// Of one judged module: of all passes its even part, of sharing that of its neighbours, of which others have fewer.
// (Timers of single modules would say less: rasterisers that sort by tiles draw all layers of a tile in turn.)
PassSums sums_of(const proto::NodeReport& report, const PlaceRenderers::Parts& parts) {
  PassSums sums;
  for (const proto::PassTime& pass : report.pass()) {
    const double of_module = pass.pass() == "share" ? parts.of_sharing : parts.even;
    if (is_occlusion_pass(pass.pass())) sums.occlusion_ms += of_module * pass.gpu_ms();
    if (is_blur_pass(pass.pass())) sums.blur_ms += of_module * pass.gpu_ms();
  }
  return sums;
}

Openness openness_of(const FrameResult& frame, std::uint32_t module) {
  const auto image = std::ranges::find_if(
      frame.images, [&](const ModuleImage& one) { return one.module == module && one.kind == proto::AO; });
  LFD_CHECK(image != frame.images.end(), "occlusion of every module was asked for");
  const PictureF picture = picture_of(*image);
  Openness open{image->size, std::vector<float>(picture.rgba.size() / 4)};
  for (std::size_t i = 0; i < open.value.size(); ++i)
    open.value[i] = picture.rgba[4 * i + 3] == 0 ? -1.0F : 1 - picture.rgba[4 * i];
  return open;
}

// The rung at this radius; its curve is left to the judges.
proto::AmbientOcclusion settings_of(const Rung& rung, double radius_m) {
  proto::AmbientOcclusion ao = rung.settings;
  ao.set_enabled(true);
  ao.set_radius_m(radius_m);
  ao.mutable_curve()->set_a(0);
  ao.mutable_curve()->set_b(1);
  ao.mutable_curve()->set_c(1);
  return ao;
}

constexpr BufferSet kOcclusion{1U << proto::AO};  // also where a scene's colours need none

Result<PassSums> time_once(PlaceRenderers& renderers, const proto::AmbientOcclusion& ao) {
  LFD_TRY(const FrameResult frame, renderers.draw(ao, kOcclusion, false));
  return sums_of(frame.report, renderers.parts(ao));
}

// What it shows.
Result<Measurement> look(PlaceRenderers& renderers, std::uint32_t module, const proto::AmbientOcclusion& ao) {
  LFD_TRY(const FrameResult frame, renderers.draw(ao, kOcclusion, true));
  Measurement seen;
  seen.layers = renderers.layers(ao);
  seen.open = openness_of(frame, module);
  if (const auto beside = renderers.beside()) seen.beside = openness_of(frame, *beside);
  return seen;
}

Rung yardstick() {
  Rung rung;
  rung.settings.set_method("sphere");
  return rung;
}

}  // namespace

PlaceRenderers::Parts PlaceRenderers::parts(const proto::AmbientOcclusion& ao) {
  const auto& modules = renderer(ao.shared().neighbours()).modules();
  const auto neighbours_of = [&](std::uint32_t module) {
    return std::ranges::count_if(modules, [&](std::uint32_t other) {
      const auto apart = std::max(module, other) - std::min(module, other);
      return apart > 0 && apart <= static_cast<std::uint32_t>(ao.shared().neighbours());
    });
  };
  std::ptrdiff_t all = 0, judged = neighbours_of(module_) + neighbours_of(beside().value_or(module_));
  for (const std::uint32_t module : modules) all += neighbours_of(module);
  return {1.0 / static_cast<double>(modules.size()),
          all == 0 ? 0 : 0.5 * static_cast<double>(judged) / static_cast<double>(all)};
}

std::optional<std::uint32_t> PlaceRenderers::beside() const {
  if (module_ + 1 < scene_.display().modules.size()) return module_ + 1;
  if (module_ > 0) return module_ - 1;
  return std::nullopt;
}

Renderer& PlaceRenderers::renderer(int neighbours) {
  std::unique_ptr<Renderer>& made = of_neighbours_[neighbours];
  if (made) return *made;
  const int count = static_cast<int>(scene_.display().modules.size());
  const int low = static_cast<int>(std::min(module_, beside().value_or(module_)));
  const int high = static_cast<int>(std::max(module_, beside().value_or(module_)));
  std::vector<std::uint32_t> modules;
  for (int i = std::max(0, low - neighbours); i <= std::min(count - 1, high + neighbours); ++i)
    modules.push_back(static_cast<std::uint32_t>(i));
  made = std::make_unique<Renderer>(context_, scene_.display(), std::move(modules));
  return *made;
}

int PlaceRenderers::layers(const proto::AmbientOcclusion& ao) {
  return static_cast<int>(renderer(ao.shared().neighbours()).modules().size());
}

Result<FrameResult> PlaceRenderers::draw(const proto::AmbientOcclusion& ao, const BufferSet& buffers, bool read_back) {
  Renderer& one = renderer(ao.shared().neighbours());
  LFD_TRY_STATUS(one.set_state(scene_.state(ao), scene_.assets()));
  LFD_TRY_STATUS(one.draw({.buffers = buffers, .time_modules = false, .reuse = false, .read_back = read_back}));
  return one.collect();
}

Result<std::vector<SharedPoint>> PlaceRenderers::shared_points() {
  if (!beside()) return std::vector<SharedPoint>();
  proto::AmbientOcclusion off;
  off.set_enabled(false);
  BufferSet surfaces;
  surfaces.bits = 1U << proto::POSITION | 1U << proto::NORMAL;
  LFD_TRY(const FrameResult frame, draw(off, surfaces, true));
  const auto shown = [&](std::uint32_t module) {
    ShownSurfaces surface{&scene_.display().modules[module], {}, {}};
    for (const ModuleImage& image : frame.images) {
      if (image.module != module || image.kind == proto::COLOR) continue;
      (image.kind == proto::POSITION ? surface.position : surface.normal) = picture_of(image);
    }
    return surface;
  };
  Affine<Physical, World> from_origin = physical_from_world(scene_.roi());
  from_origin.offset = to_glm(from_origin * frame.position_origin);
  return bench::shared_points(scene_.display(), shown(module_), shown(*beside()), from_origin);
}

Result<std::vector<Measurement>> measure(PlaceRenderers& renderers, const ShownScene& scene, std::uint32_t module,
                                         const std::vector<Rung>& rungs, const MeasureOptions& options) {
  const KeptMeasurements kept({scene, module, rungs, renderers.context().description()}, options);
  if (options.resume) {
    if (auto known = kept.read()) return *std::move(known);
  }
  std::vector<Measurement> seen;
  for (const Rung& rung : rungs) {
    LFD_TRY(Measurement one, look(renderers, module, settings_of(rung, options.radius_m)));
    seen.push_back(std::move(one));
  }
  const proto::AmbientOcclusion measure_by = settings_of(yardstick(), options.radius_m);
  LFD_TRY_STATUS(time_once(renderers, measure_by));  // not counted: shaders are compiled
  std::vector<double> took_ms(rungs.size());
  for (int frame = 0; frame < options.frames; ++frame) {
    LFD_TRY(const PassSums unit, time_once(renderers, measure_by));
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      if (took_ms[i] > kSlow_ms) continue;
      const auto start = Clock::now();
      LFD_TRY(const PassSums sums, time_once(renderers, settings_of(rungs[i], options.radius_m)));
      took_ms[i] = milliseconds(Clock::now() - start);
      seen[i].occlusion_ms.push_back(sums.occlusion_ms);
      seen[i].blur_ms.push_back(sums.blur_ms);
      seen[i].ratio.push_back(sums.occlusion_ms / unit.occlusion_ms);
    }
  }
  LFD_TRY_STATUS(kept.write(seen));
  auto rounded = kept.read();  // as a run that goes on takes it
  if (!rounded) return Error(fmt::format("{}: measurements written, but not to be read", options.cache.string()));
  return *std::move(rounded);
}

}  // namespace lfd::bench
