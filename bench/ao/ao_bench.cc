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
#include "bench/reference/parallel_rows.h"
#include "proto/pictures/png.h"

namespace lfd::bench {
namespace {

// One module of one scene with all its reference pictures.
struct JudgedPlace {
  std::shared_ptr<const ShownScene> scene;
  std::uint32_t module = 0;
  PlaceKind kind = PlaceKind::kMiddle;
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

double middle_of(std::vector<double> radii) {
  if (radii.empty()) return 0;
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
    LFD_TRY(table_.by_size, scale_size(inputs, middle_of(options_.radii)));
    LFD_TRY(table_.sharing, scale_modules(inputs, middle_of(options_.radii)));
    return std::move(table_);
  }

 private:
  Result<std::vector<std::shared_ptr<const ShownScene>>> load_scenes() {
    std::vector<std::shared_ptr<const ShownScene>> scenes;
    const auto load = [&](const std::filesystem::path& deployment,
                          const std::optional<std::filesystem::path>& file) -> Status {
      log::info("loading {}", (file ? *file : deployment).string());
      LFD_TRY(auto scene, ShownScene::load(deployment, {options_.display, file}, options_.size));
      for (const std::size_t count = scene->display().modules.size(); const std::uint32_t module : options_.modules) {
        if (module >= count) return Error(fmt::format("module {}: the display has {}", module, count));
      }
      scenes.push_back(std::move(scene));
      return {};
    };
    for (const auto& deployment : options_.deployments) LFD_TRY_STATUS(load(deployment, std::nullopt));
    for (const auto& file : options_.scenes) LFD_TRY_STATUS(load(options_.deployments.front(), file));
    // Rows, fits and files go by scenes' names.
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (stem_of(scenes[i]->name()) == stem_of(scenes[j]->name()))
          return Error(fmt::format("\"{}\" and \"{}\": scenes whose names begin alike cannot be told apart",
                                   scenes[j]->name(), scenes[i]->name()));
      }
    }
    return scenes;
  }

  std::vector<std::pair<std::uint32_t, PlaceKind>> modules_of(std::uint32_t count) const {
    std::vector<std::pair<std::uint32_t, PlaceKind>> modules;
    for (const std::uint32_t module : options_.modules)
      modules.emplace_back(module, modules.empty() ? PlaceKind::kMiddle : PlaceKind::kEdge);
    if (!modules.empty()) return modules;
    modules.emplace_back(count / 2, PlaceKind::kMiddle);
    if (count > 1) modules.emplace_back(0, PlaceKind::kEdge);
    if (count > 2) modules.emplace_back(count - 1, PlaceKind::kOtherEdge);
    return modules;
  }

  Status load_places() {
    LFD_TRY(const auto scenes, load_scenes());
    for (const auto& scene : scenes) {
      for (const auto& [module, kind] : modules_of(static_cast<std::uint32_t>(scene->display().modules.size())))
        LFD_TRY_STATUS(add_place(scene, module, kind));
    }
    return {};
  }

  std::vector<double> radii_of(PlaceKind kind) const {
    if (kind == PlaceKind::kOtherEdge) return {middle_of(options_.radii)};
    return options_.radii;
  }

  Status add_place(const std::shared_ptr<const ShownScene>& scene, std::uint32_t module, PlaceKind kind) {
    JudgedPlace place{scene, module, kind, {}, {}, {}};
    const auto hits = reference::cast_module(scene->intersector(), scene->view(module));
    std::vector<double> radius_m;
    for (const double share : radii_) {
      radius_m.push_back(share * scene->roi().diagonal_m());
      place.px_per_radius.push_back(mean_length_px(*scene, module, hits, radius_m.back()));
    }
    LFD_TRY(place.reference, reference_picture(*scene, module, hits, radius_m, options_.rays, options_.out / "cache"));
    if (std::ranges::none_of(place.reference.cosine.front().value, [](float open) { return open >= 0; }))
      return Error(fmt::format("{}: module {} sees nothing of it", scene->name(), module));
    for (const double share : radii_of(kind)) {
      const std::size_t k = index_of(radii_, share);
      const Openness& open = place.reference.cosine[k];
      const double none = difference(open, all_open(open)).mae;
      table_.places.push_back({scene->name(), scene->display().name, module, kind, scene->display().image, share,
                               radius_m[k], place.px_per_radius[k], none, place.reference.cast_ms});
    }
    places_.push_back(std::move(place));
    return {};
  }

  static Openness all_open(const Openness& like) { return {like.size, std::vector<float>(like.value.size(), 1)}; }

  std::vector<Rung> rungs_at(const JudgedPlace& place, double share) const {
    std::vector<Rung> rungs;
    const bool is_study = place.kind == PlaceKind::kMiddle && share == middle_of(options_.radii);
    std::ranges::copy_if(rungs_, std::back_inserter(rungs),
                         [&](const Rung& rung) { return is_study || rung.use == RungUse::kEverywhere; });
    if (place.kind == PlaceKind::kOtherEdge)
      std::erase_if(rungs, [](const Rung& rung) { return rung.settings.shared().neighbours() == 0; });
    return rungs;
  }

  MeasureOptions measuring(const JudgedPlace& place, double share, bool resume) const {
    return {place.reference.radius_m[index_of(radii_, share)], options_.frames, resume, options_.out / "cache"};
  }

  Status draw(JudgedPlace& place) {
    PlaceRenderers renderers(context_, *place.scene, place.module);
    LFD_TRY(place.points, renderers.shared_points());
    for (const double share : radii_of(place.kind)) {
      log::info("{}, module {}, radius {}: drawing", place.scene->name(), place.module, share);
      const std::vector<Rung> rungs = rungs_at(place, share);
      if (rungs.empty()) continue;
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
    for (const double share : radii_of(place.kind)) {
      log::info("{}, module {}, radius {}: judging", place.scene->name(), place.module, share);
      const std::vector<Rung> rungs = rungs_at(place, share);
      if (rungs.empty()) continue;
      // Pictures of all places at once would not fit into memory: they are read again.
      LFD_TRY(const auto seen, measure(renderers, *place.scene, place.module, rungs, measuring(place, share, true)));
      std::vector<std::optional<Result<AoRow>>> rows(rungs.size());
      reference::for_each_row(static_cast<int>(rungs.size()), [&](int row) {
        const auto i = static_cast<std::size_t>(row);
        rows[i] = row_of(place, share, rungs[i], seen[i]);
      });
      for (auto& judged : rows) {
        LFD_TRY(AoRow row, *std::move(judged));
        table_.rows.push_back(std::move(row));
      }
    }
    return {};
  }

  // From several threads at once: only the default of each method writes a strip, and under its own name.
  Result<AoRow> row_of(const JudgedPlace& place, double share, const Rung& rung, const Measurement& seen) const {
    const std::size_t k = index_of(radii_, share);
    LFD_TRY(const RenderSettings settings, read_settings(place.scene->state(rung.settings).render()));
    AoRow row;
    row.scene = place.scene->name();
    row.display = place.scene->display().name;
    row.module = place.module;
    row.place = place.kind;
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
    row.mae_over_all = row.judged.mae;
    if (const auto curve = fits_.without(row.scene, rung)) row.mae_over_all = judge.judge(seen, *curve).mae;
    if (const auto curve = fits_.over_all(rung)) row.curve_over_all = *curve;
    if (rung.is_default) LFD_TRY_STATUS(write_strip(row, judge.cosine, seen));
    return row;
  }

  Status write_strip(const AoRow& row, const Openness& reference, const Measurement& seen) const {
    const std::string name = fmt::format("{}-module-{:03}-radius-{:g}-{}.png", stem_of(row.scene), row.module,
                                         row.radius_share, row.rung.method());
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

const char* name_of(PlaceKind place) {
  return place == PlaceKind::kMiddle ? "middle" : place == PlaceKind::kEdge ? "edge" : "other edge";
}

const AoJudgement& fitted_or_not(const AoRow& row) { return row.fitted ? row.fitted->judged : row.judged; }

std::string stem_of(const std::string& scene) { return scene.substr(0, scene.find_first_of(". ")); }

double AoTable::middle_radius() const {
  std::vector<double> radii;
  for (const AoPlaceFacts& one : places) {
    if (std::ranges::find(radii, one.radius_share) == radii.end()) radii.push_back(one.radius_share);
  }
  return middle_of(radii);
}

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
