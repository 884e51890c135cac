// Scene by scene, place by place: first everything is drawn, then it is judged with curves fitted on the other scenes.
#include "bench/ao/ao_bench.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/file.h"
#include "base/log.h"
#include "bench/ao/judge.h"
#include "bench/ao/scaling.h"
#include "bench/ao/strips.h"
#include "bench/common/built_commit.h"
#include "proto/pictures/png.h"

namespace lfd::bench {
namespace {

// One module of one scene with all its reference pictures.
struct JudgedPlace {
  std::shared_ptr<const ShownScene> scene;
  std::uint32_t module = 0;
  bool is_middle = true;
  ReferencePicture reference;
  std::vector<double> px_per_radius;  // by radius
  std::vector<SharedPoint> points;
};

// Radii that are drawn: those asked for, and those of the scaling.
std::vector<double> cast_radii(const AoBenchOptions& options) {
  std::vector<double> radii = options.radii;
  for (const double share : scaling_radii()) {
    if (std::ranges::find(radii, share) == radii.end()) radii.push_back(share);
  }
  std::ranges::sort(radii);
  return radii;
}

std::size_t index_of(const std::vector<double>& radii, double share) {
  return static_cast<std::size_t>(std::ranges::find(radii, share) - radii.begin());
}

double middle_radius(const AoBenchOptions& options) {
  std::vector<double> radii = options.radii;
  std::ranges::sort(radii);
  return radii[radii.size() / 2];
}

class Bench {
 public:
  Bench(const gl::Context& context, const AoBenchOptions& options)
      : context_(context), options_(options), radii_(cast_radii(options)), rungs_(ladder(options.methods)) {}

  Result<AoTable> run() {
    table_.renderer = context_.description();
    table_.is_software = context_.is_software();
    table_.version = built_version();
    table_.rays = options_.rays;
    for (const char* folder : {"cache", "strips"}) LFD_TRY_STATUS(make_folder(options_.out / folder));
    LFD_TRY_STATUS(load_places());
    for (JudgedPlace& place : places_) LFD_TRY_STATUS(draw(place));
    for (JudgedPlace& place : places_) LFD_TRY_STATUS(judge(place));
    const ScalingInputs inputs{context_, options_, *places_.front().scene, places_.front().module, rungs_};
    LFD_TRY(table_.by_radius, scale_radius(inputs, places_.front().reference));
    LFD_TRY(table_.by_size, scale_size(inputs, middle_radius(options_)));
    LFD_TRY(table_.sharing, scale_modules(inputs, middle_radius(options_)));
    return std::move(table_);
  }

 private:
  Result<std::vector<std::shared_ptr<const ShownScene>>> load_scenes() {
    std::vector<std::shared_ptr<const ShownScene>> scenes;
    const auto load = [&](const std::filesystem::path& deployment,
                          const std::optional<std::filesystem::path>& file) -> Status {
      log::info("loading {}", (file ? *file : deployment).string());
      LFD_TRY(auto scene, ShownScene::load(deployment, {options_.display, file}, options_.size));
      scenes.push_back(std::move(scene));
      return {};
    };
    for (const auto& deployment : options_.deployments) LFD_TRY_STATUS(load(deployment, std::nullopt));
    for (const auto& file : options_.scenes) LFD_TRY_STATUS(load(options_.deployments.front(), file));
    return scenes;
  }

  Status load_places() {
    LFD_TRY(const auto scenes, load_scenes());
    for (const auto& scene : scenes) {
      const auto count = static_cast<std::uint32_t>(scene->display().modules.size());
      std::vector<std::uint32_t> modules = options_.modules;
      if (modules.empty())
        modules = count > 1 ? std::vector<std::uint32_t>{count / 2, 0} : std::vector<std::uint32_t>{0};
      for (const std::uint32_t module : modules) {
        if (module >= count) return Error(fmt::format("module {}: the display has {}", module, count));
        LFD_TRY_STATUS(add_place(scene, module, module == modules.front()));
      }
    }
    return {};
  }

  Status add_place(const std::shared_ptr<const ShownScene>& scene, std::uint32_t module, bool is_middle) {
    JudgedPlace place{scene, module, is_middle, {}, {}, {}};
    const auto hits = reference::cast_module(scene->intersector(), scene->view(module));
    std::vector<double> radius_m;
    for (const double share : radii_) {
      radius_m.push_back(share * scene->roi().diagonal_m());
      place.px_per_radius.push_back(mean_length_px(*scene, module, hits, radius_m.back()));
    }
    LFD_TRY(place.reference, reference_picture(*scene, module, hits, radius_m, options_.rays, options_.out / "cache"));
    if (std::ranges::none_of(place.reference.cosine.front().value, [](float open) { return open >= 0; }))
      return Error(fmt::format("{}: module {} sees nothing of it", scene->name(), module));
    for (const double share : options_.radii) {
      const Openness& open = place.reference.cosine[index_of(radii_, share)];
      const double none = difference(open, all_open(open)).mae;
      table_.places.push_back({scene->name(), module, share, none, place.reference.cast_ms});
    }
    places_.push_back(std::move(place));
    return {};
  }

  static Openness all_open(const Openness& like) { return {like.size, std::vector<float>(like.value.size(), 1)}; }

  std::vector<Rung> rungs_at(const JudgedPlace& place, double share) const {
    std::vector<Rung> rungs;
    const bool is_study = place.is_middle && share == middle_radius(options_);
    std::ranges::copy_if(rungs_, std::back_inserter(rungs),
                         [&](const Rung& rung) { return is_study || rung.use == RungUse::kEverywhere; });
    return rungs;
  }

  MeasureOptions measuring(const JudgedPlace& place, double share, bool resume) const {
    return {place.reference.radius_m[index_of(radii_, share)], options_.frames, 2000, resume, options_.out / "cache"};
  }

  Status draw(JudgedPlace& place) {
    PlaceRenderers renderers(context_, *place.scene, place.module);
    LFD_TRY(place.points, renderers.shared_points());
    for (const double share : options_.radii) {
      log::info("{}, module {}, radius {}: drawing", place.scene->name(), place.module, share);
      const std::vector<Rung> rungs = rungs_at(place, share);
      LFD_TRY(const auto seen,
              measure(renderers, *place.scene, place.module, rungs, measuring(place, share, options_.resume)));
      for (std::size_t i = 0; i < rungs.size(); ++i) {
        JointHistogram histogram;
        histogram.add(seen[i].open, place.reference.cosine[index_of(radii_, share)]);
        fits_.add(place.scene->name(), rungs[i], share, histogram);
      }
    }
    return {};
  }

  Status judge(const JudgedPlace& place) {
    PlaceRenderers renderers(context_, *place.scene, place.module);
    for (const double share : options_.radii) {
      log::info("{}, module {}, radius {}: judging", place.scene->name(), place.module, share);
      const std::vector<Rung> rungs = rungs_at(place, share);
      // Pictures of all places at once would not fit into memory: they are read again.
      LFD_TRY(const auto seen, measure(renderers, *place.scene, place.module, rungs, measuring(place, share, true)));
      for (std::size_t i = 0; i < rungs.size(); ++i) LFD_TRY_STATUS(add_row(place, share, rungs[i], seen[i]));
    }
    return {};
  }

  Status add_row(const JudgedPlace& place, double share, const Rung& rung, const Measurement& seen) {
    const std::size_t k = index_of(radii_, share);
    LFD_TRY(const RenderSettings settings, read_settings(place.scene->state(rung.settings).render()));
    AoRow row;
    row.scene = place.scene->name();
    row.display = place.scene->display().name;
    row.module = place.module;
    row.is_middle = place.is_middle;
    row.image = place.scene->display().image;
    row.radius_share = share;
    row.radius_m = place.reference.radius_m[k];
    row.radius_px = place.px_per_radius[k];
    row.rung = rung;
    row.blur = blur_name(settings.ao);
    row.taps = taps_of(settings.ao);
    row.layers = seen.layers;
    row.frames = seen.occlusion_ms.size();
    row.occlusion_ms = spread_of(seen.occlusion_ms);
    row.blur_ms = spread_of(seen.blur_ms);
    row.ratio = spread_of(seen.ratio);
    row.curve = curve_of(rung);
    const Judge judge{place.reference.cosine[k], place.reference.uniform[k], place.reference.silhouette, place.points};
    row.judged = judge.judge(seen, row.curve);
    if (const auto curve = fits_.without(row.scene, rung, share)) row.fitted = AoFit{*curve, judge.judge(seen, *curve)};
    row.pixels = difference(judge.cosine, seen.open).pixels;
    row.shared_points = place.points.size();
    if (const auto curve = fits_.over_all(rung)) row.curve_over_all = *curve;
    if (rung.is_default) LFD_TRY_STATUS(write_strip(row, judge.cosine, seen));
    table_.rows.push_back(std::move(row));
    return {};
  }

  Status write_strip(const AoRow& row, const Openness& reference, const Measurement& seen) const {
    const std::string name =
        fmt::format("{}-module-{:03}-radius-{:g}-{}.png", row.scene.substr(0, row.scene.find_first_of(". ")),
                    row.module, row.radius_share, row.rung.method());
    return write_png(options_.out / "strips" / name, strip_of(reference, curved(seen.open, row.curve)));
  }

  const gl::Context& context_;
  const AoBenchOptions& options_;
  const std::vector<double> radii_;
  const std::vector<Rung> rungs_;
  std::vector<JudgedPlace> places_;
  Fits fits_;
  AoTable table_;
};

}  // namespace

std::vector<std::string> AoTable::scenes() const {
  std::vector<std::string> names;
  for (const AoRow& row : rows) {
    if (std::ranges::find(names, row.scene) == names.end()) names.push_back(row.scene);
  }
  return names;
}

Status check_options(const AoBenchOptions& options) {
  if (options.deployments.empty()) return Error("a deployment is needed");
  if (options.frames < 1) return Error(fmt::format("frames: {}; at least 1 is needed", options.frames));
  if (options.rays < 4) return Error(fmt::format("rays: {}; at least 4 are needed", options.rays));
  if (options.radii.empty()) return Error("radii: at least one is needed");
  for (const double radius : options.radii) {
    if (!(radius >= 1e-3 && radius <= 10))
      return Error(fmt::format("radius {}: shares of 0.001 to 10 are possible", radius));
  }
  for (const std::string& method : options.methods) {
    if (occlusion::find_method(method) == nullptr) return Error(fmt::format("method \"{}\" is none", method));
  }
  return {};
}

Result<AoTable> ao_bench(const gl::Context& context, const AoBenchOptions& options) {
  LFD_TRY_STATUS(check_options(options));
  return Bench(context, options).run();
}

Result<AoTable> ao_bench(const AoBenchOptions& options) {
  LFD_TRY(const std::unique_ptr<gl::Context> context, gl::Context::create(options.gpu));
  return ao_bench(*context, options);
}

}  // namespace lfd::bench
