// The rungs.
#include "bench/ao/ladder.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "base/check.h"
#include "base/log.h"

namespace lfd::bench {
namespace {

using Parameters = std::initializer_list<std::pair<const char*, double>>;
constexpr const char* kPyramidTable = "Pyramid HBAO, table 1";

Rung rung(const char* method, std::string name, Parameters parameters, int samples = 0, const char* origin = "") {
  Rung made{std::move(name), origin, RungUse::kEverywhere, false, {}};
  made.settings.set_method(method);
  made.settings.set_samples(samples);
  for (const auto& [key, value] : parameters) (*made.settings.mutable_parameter())[key] = value;
  return made;
}

Rung of_samples(const char* method, int samples, const char* origin = "") {
  return rung(method, fmt::format("{} samples", samples), {}, samples, origin);
}

Rung with_curve(Rung made, double a, double b, double c) {
  made.settings.mutable_curve()->set_a(a);
  made.settings.mutable_curve()->set_b(b);
  made.settings.mutable_curve()->set_c(c);
  return made;
}

Rung of_directions(const char* method, int directions, int steps, const char* origin = "") {
  return rung(method, fmt::format("{} directions, {} steps", directions, steps),
              {{"directions", directions}, {"steps", steps}}, 0, origin);
}

Rung of_march(int directions, int steps) {
  return rung("march", fmt::format("{} directions, {} steps", directions, steps), {{"steps", steps}}, directions);
}

Rung of_slices(int slices, int steps, bool bitmask) {
  return rung("gtao", fmt::format("{} slices, {} steps{}", slices, steps, bitmask ? ", bitmask" : ""),
              {{"slices", slices}, {"steps", steps}, {"bitmask", bitmask ? 1 : 0}});
}

Rung of_levels(const char* method, int levels, Parameters more = {}) {
  Rung made = rung(method, fmt::format("{} level{}", levels, levels == 1 ? "" : "s"), more, 0, kPyramidTable);
  (*made.settings.mutable_parameter())["levels"] = levels;
  // As many taps on every level, of both methods, as in the table.
  if (made.method() == "scalable") made.settings.set_samples(std::min(256, 32 * levels));
  return made;
}

// Set-ups of Aalund: performance with a blur by geometry of so many taps (table 2), quality without blur and with a
// curve of its own (table 4).
Rung of_fast(Rung made, int taps) {
  made.origin = "Aalund, performance";
  made.name += ", as in 2013";
  made.settings.mutable_blur()->set_kind(proto::AmbientOcclusion::Blur::GEOMETRY);
  made.settings.mutable_blur()->set_taps(taps);
  return made;
}

Rung of_fine(Rung made, double a, double b, double c) {
  made.origin = "Aalund, quality";
  made.name += ", as in 2013";
  made.settings.mutable_blur()->set_enabled(false);
  return with_curve(std::move(made), a, b, c);
}

void add_set_ups(std::vector<Rung>& all) {
  all.push_back(of_fast(of_samples("crytek", 24), 3));
  all.push_back(of_fast(of_samples("starcraft", 15), 2));
  all.push_back(of_fast(of_directions("hbao", 8, 6), 1));
  all.push_back(of_fast(of_samples("volumetric", 24), 1));
  all.push_back(of_fast(of_samples("alchemy", 6), 2));
  all.push_back(of_fast(of_samples("unreal", 6), 2));
  all.push_back(of_fine(of_samples("crytek", 200), 0.55, 1, 4));
  all.push_back(of_fine(of_samples("starcraft", 80), 0, 1.1, 2));
  all.push_back(of_fine(of_directions("hbao", 80, 6), 0, 1, 3));
  all.push_back(of_fine(of_samples("volumetric", 40), 0.5, 1, 3));
  all.push_back(of_fine(of_samples("alchemy", 64), 0, 1, 5));
  all.push_back(of_fine(of_samples("unreal", 32), 0, 1, 3));
}

std::vector<Rung> main_rungs() {
  std::vector<Rung> all;
  const auto add = [&](Rung made) { all.push_back(std::move(made)); };
  for (const int samples : {6, 16, 64}) add(of_samples("alchemy", samples));
  for (const int samples : {8, 16, 64}) add(of_samples("crytek", samples));
  for (const auto& [slices, steps] : {std::pair{1, 3}, {2, 4}, {3, 3}, {3, 6}, {9, 3}, {9, 8}}) {
    for (const bool bitmask : {false, true}) add(of_slices(slices, steps, bitmask));
  }
  add(of_directions("hbao", 4, 4));
  add(of_directions("hbao", 8, 6));
  for (const int d : {8, 16, 32, 64}) add(of_directions("hbao", d, d * 5 / 4, kPyramidTable));
  for (const auto& [directions, steps] : {std::pair{1, 4}, {2, 4}, {4, 4}, {8, 4}, {16, 4}, {32, 4}, {64, 8}})
    add(of_march(directions, steps));
  for (int levels = 1; levels <= 5; ++levels) add(of_levels("pyramid_hbao", levels));
  for (int levels = 1; levels <= 5; ++levels) add(of_levels("scalable", levels));
  add(of_samples("scalable", 16));
  add(rung("schmitt", "8 neighbours", {}));
  for (const int samples : {4, 8, 16, 32, 64}) add(of_samples("sphere", samples));
  Rung five = of_samples("sphere", 8, "Doronin et al., 5 radii");
  five.name += ", 5 radii";
  five.settings.set_radii(5);
  add(five);
  for (const int samples : {8, 16, 32, 80}) add(of_samples("starcraft", samples));
  for (const int samples : {6, 12, 32}) add(of_samples("unreal", samples));
  for (const int samples : {8, 16, 40}) add(of_samples("volumetric", samples));
  add_set_ups(all);
  return all;
}

// What a deployment gets that says no more than the method.
Rung plain(const std::string& method, const std::string& name) {
  Rung made = rung(method.c_str(), name, {});
  made.use = RungUse::kStudy;
  return made;
}

void add_blurs(std::vector<Rung>& all, const std::string& method) {
  Rung none = plain(method, "default, no blur");
  none.settings.mutable_blur()->set_enabled(false);
  all.push_back(none);
  Rung wide = plain(method, "default, wide blur");
  wide.settings.mutable_blur()->set_sigma_px(3);
  all.push_back(wide);
  for (const int taps : {1, 3}) {
    Rung keeping = plain(method, fmt::format("default, blur by geometry {}", taps));
    keeping.settings.mutable_blur()->set_kind(proto::AmbientOcclusion::Blur::GEOMETRY);
    keeping.settings.mutable_blur()->set_taps(taps);
    all.push_back(keeping);
  }
}

void add_options(std::vector<Rung>& all, const std::string& method) {
  Rung half = plain(method, "default, half resolution");
  half.settings.set_half_resolution(true);
  all.push_back(half);
  Rung guard = plain(method, "default, guard band of 64 px");
  guard.settings.set_guard_band_px(64);
  all.push_back(guard);
  if (method == "schmitt") return;
  Rung fewer = plain(method, "default, fewer samples far away");
  fewer.settings.set_least_samples(2);
  all.push_back(fewer);
}

// Neighbours help: over +-4 modules, with and without their sight of open air; alone without blur beside them.
void add_sharing(std::vector<Rung>& all) {
  const auto add = [&](Rung made, int neighbours, bool open_air, bool blur) {
    if (!blur || neighbours != 4) made.use = RungUse::kStudy;
    if (neighbours > 0) made.name += fmt::format(", shared over +-{}{}", neighbours, open_air ? ", open air" : "");
    if (!blur) made.name += ", no blur";
    made.settings.mutable_shared()->set_neighbours(neighbours);
    made.settings.mutable_shared()->set_open_air(open_air);
    made.settings.mutable_blur()->set_enabled(blur);
    all.push_back(made);
  };
  const auto solid = [](int directions) {
    Rung made = of_march(directions, 4);
    made.name += ", no thickness limit";
    (*made.settings.mutable_parameter())["thickness"] = 1000;
    return made;
  };
  for (const bool blur : {false, true}) {
    for (const int directions : {1, 2, 4}) add(of_march(directions, 4), 4, false, blur);
    add(solid(4), 4, true, blur);
  }
  add(solid(4), 0, false, false);
  add(of_march(4, 4), 0, false, false);
  add(of_march(32, 4), 0, false, false);
  add(of_march(4, 4), 1, false, true);
  add(of_march(4, 4), 8, false, true);
  add(of_slices(1, 3, false), 4, false, true);
  add(of_samples("sphere", 8), 4, false, true);
  add(of_samples("alchemy", 6), 4, false, true);
}

}  // namespace

std::vector<Rung> ladder(const std::vector<std::string>& methods) {
  std::vector<Rung> all = main_rungs();
  for (const occlusion::Method* method : occlusion::methods()) {
    add_blurs(all, std::string(method->name));
    add_options(all, std::string(method->name));
  }
  add_sharing(all);
  for (const occlusion::Method* method : occlusion::methods()) {
    Rung usual = plain(std::string(method->name), "default");
    usual.use = RungUse::kEverywhere;
    usual.is_default = true;
    all.push_back(usual);
  }
  std::erase_if(all, [&](const Rung& one) {
    return !methods.empty() && std::ranges::find(methods, one.method()) == methods.end();
  });
  std::ranges::stable_sort(all, {}, &Rung::method);
  return all;
}

TapCount taps_of(const AoSettings& settings) {
  const auto parameter = [&](const char* name) { return static_cast<int>(settings.parameter(name)); };
  const std::string_view method = settings.method->name;
  constexpr int kOnSurface = 4;  // a surface through four pixels
  int samples = settings.samples, each = 1;
  if (method == "march") samples *= parameter("steps");
  if (method == "hbao") samples = parameter("directions") * parameter("steps");
  if (method == "pyramid_hbao") samples = parameter("levels") * parameter("directions") * parameter("steps");
  if (method == "gtao") samples = 2 * parameter("slices") * parameter("steps");
  if (method == "schmitt") samples = 8;
  if (method == "schmitt") each = 2;  // positions and normals
  if (settings.method->points || method == "volumetric") each = kOnSurface;
  if (settings.shared_open_air) each += 2 * kOnSurface;  // of both outermost neighbours
  samples *= settings.radii;
  double fetches = (settings.method->normal ? 2 : 1) + samples * each;
  if (settings.half_resolution) fetches = fetches / 4 + 2 + 4 * 3;  // upsampling: four values with position and normal
  if (settings.shared_neighbours > 0) fetches += 3 + 2 * settings.shared_neighbours * 3;
  return {settings.half_resolution ? samples / 4.0 : samples, fetches};
}

std::string blur_name(const AoSettings& settings) {
  if (!settings.blur_enabled) return "none";
  if (settings.blur == AoBlur::kGaussian) return fmt::format("gaussian {} px", settings.blur_sigma_px);
  return fmt::format("geometry {} taps", settings.blur_taps);
}

}  // namespace lfd::bench
