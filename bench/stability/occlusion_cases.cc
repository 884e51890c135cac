// Ambient occlusion with radii from nothing to beyond the scene.
#include <algorithm>
#include <cmath>
#include <random>

#include "base/log.h"
#include "bench/common/frame_picture.h"
#include "bench/reference/ao_limit.h"
#include "bench/reference/scene_maker.h"
#include "bench/stability/drawing.h"
#include "bench/stability/groups.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "ambient occlusion";

// A wall across the whole picture, slanted: with samples in pairs that mirror each other exactly half of them are
// hidden, whatever the radius, and the curve makes that 0 (design ambient-occlusion, "Sample sets").
SceneData wall() {
  reference::SceneMaker maker;
  maker.add_quad({-0.6F, -0.6F, -0.14F}, {0.6F, -0.6F, 0.02F}, {0.6F, 0.6F, 0.02F}, {-0.6F, 0.6F, -0.14F},
                 maker.add_material({}));
  return maker.data();
}

// The wall with ridges before it, in whose corners much is hidden.
SceneData ridges() {
  reference::SceneMaker maker;
  const auto plain = maker.add_material({.double_sided = true});
  maker.add_quad({-0.6F, -0.6F, -0.12F}, {0.6F, -0.6F, -0.12F}, {0.6F, 0.6F, -0.12F}, {-0.6F, 0.6F, -0.12F}, plain);
  for (const float x : {-0.12F, -0.04F, 0.04F, 0.12F}) {
    maker.add_quad({x - 0.04F, -0.6F, -0.12F}, {x, -0.6F, -0.05F}, {x, 0.6F, -0.05F}, {x - 0.04F, 0.6F, -0.12F}, plain);
    maker.add_quad({x, -0.6F, -0.05F}, {x + 0.04F, -0.6F, -0.12F}, {x + 0.04F, 0.6F, -0.12F}, {x, 0.6F, -0.05F}, plain);
  }
  return maker.data();
}

Drawing drawing_of(SceneData data, double radius_m, double radius_roi = 0) {
  Drawing drawing{small_display(), std::move(data), small_roi(), {}};
  auto& ao = *drawing.settings.mutable_ao();
  (*ao.mutable_parameter())["symmetric"] = 1;
  ao.mutable_blur()->set_enabled(false);
  ao.set_radius_m(radius_m);
  ao.set_radius_roi(radius_roi);
  return drawing;
}

struct Occlusion {
  double mean = 0, largest = 0;
  std::size_t count = 0;  // pixels with a surface
};

Occlusion occlusion_of(const FrameResult& frame) {
  const std::vector<float> rgba = picture_of(frame, proto::AO).rgba;
  Occlusion found;
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    if (rgba[i + 3] == 0) continue;
    ++found.count;
    found.mean += rgba[i];
    found.largest = std::max(found.largest, static_cast<double>(rgba[i]));
  }
  if (found.count > 0) found.mean /= static_cast<double>(found.count);
  return found;
}

StabilityCase open_wall(std::string name, double radius_m, double radius_roi = 0) {
  // Samples beyond the border of the picture count as open, never as hidden; one of the 8 samples may be rounded to the
  // wrong side at a pixel. The wall fills the picture of 12288 pixels.
  constexpr double kMean = 0.01;
  constexpr std::size_t kPixels = 12000;
  return {kGroup, std::move(name),
          fmt::format("a flat wall is open: mean at most {} on {} pixels at least; all finite", kMean, kPixels),
          [radius_m, radius_roi](const gl::Context& context) -> Outcome {
            const auto drawn = draw(context, drawing_of(wall(), radius_m, radius_roi));
            if (!drawn) return {"error: " + drawn.error().message(), 0, false};
            const Occlusion found = occlusion_of(drawn->frame);
            const std::string got =
                fmt::format("mean {:.2g}, largest {:.2g} on {} pixels", found.mean, found.largest, found.count);
            return {drawn->fault.empty() ? got : drawn->fault, found.mean,
                    drawn->fault.empty() && found.mean <= kMean && found.count >= kPixels};
          }};
}

// Drawn and limit at pixels chosen at random, away from the picture's border: mean of both, and of their difference.
struct Against {
  double drawn = 0, limit = 0;
  int count = 0;
};

Result<Against> against_limit(const Drawing& drawing, const Drawn& drawn, double radius_m) {
  LFD_TRY(const RenderSettings settings, read_settings(drawing.settings));
  LFD_TRY(const reference::WorldScene scene, reference::world_scene(drawing.data, drawing.roi));
  const reference::Intersector intersector(scene);
  const DepthLimits limits = depth_limits(drawing.display, settings);
  const reference::ModuleView view{drawing.display, drawing.display.modules[0], {limits.front, limits.back}};
  const PictureF ao = picture_of(drawn.frame, proto::AO);
  std::mt19937 random(1);
  std::uniform_int_distribution<int> columns(12, ao.width - 13), rows(12, ao.height - 13);
  Against sum;
  for (int i = 0; i < 200; ++i) {
    const PixelIndex pixel{columns(random), rows(random)};
    const auto hit = reference::cast_point(intersector, view, centre_of(pixel));
    const float* found = &ao.rgba[4 * (static_cast<std::size_t>(pixel.row) * ao.width + pixel.column)];
    if (!hit || found[3] == 0) continue;
    const auto limit = reference::ao_limit(intersector, view, hit->world, settings.ao,
                                           {.radius_m = radius_m, .samples = 1000, .seed = 1});
    sum.drawn += found[0];
    sum.limit += limit.curved;
    ++sum.count;
  }
  sum.drawn /= std::max(sum.count, 1);
  sum.limit /= std::max(sum.count, 1);
  return sum;
}

// low, high: what the limit's own mean must lie between, so that the case says something.
StabilityCase ridges_as_limit(const std::string& name, double radius_m, double low, double high) {
  // The mean of 200 pixels with 256 samples each; a sample whose pixel straddles a ridge may be taken for hidden.
  constexpr double kDifference = 0.02;
  return {kGroup, name,
          fmt::format("mean within {} of the limit by casting, which is {} to {}; 200 pixels", kDifference, low, high),
          [=](const gl::Context& context) -> Outcome {
            Drawing drawing = drawing_of(ridges(), radius_m);
            drawing.settings.mutable_ao()->set_samples(256);
            const auto drawn = draw(context, drawing);
            if (!drawn) return {"error: " + drawn.error().message(), 0, false};
            const auto means = against_limit(drawing, *drawn, radius_m);
            if (!means) return {"error: " + means.error().message(), 0, false};
            const double difference = std::abs(means->drawn - means->limit);
            const std::string got =
                fmt::format("{:.3f}, limit {:.3f}, {} pixels", means->drawn, means->limit, means->count);
            return {drawn->fault.empty() ? got : drawn->fault, difference,
                    drawn->fault.empty() && means->count == 200 && difference <= kDifference && means->limit >= low &&
                        means->limit <= high};
          }};
}

}  // namespace

void add_occlusion_cases(StabilityCases& cases) {
  cases.push_back(open_wall("radius 0: the default share of the diagonal", 0));
  for (const double radius_m : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    cases.push_back(open_wall(fmt::format("radius {:g} m; a pixel is 0.003 m", radius_m), radius_m));
  }
  for (const double radius_m : {1e-8, 1e-9, 1e-30, 1e-300}) {
    cases.push_back(drawing_refused(kGroup,
                                    fmt::format("radius {:g} m: less than a rounding of the positions", radius_m),
                                    "ao: radius_m: the radius", [radius_m] { return drawing_of(wall(), radius_m); }));
  }
  for (const double radius_m : {1.0, 1e3, 1e9, 1e15}) {
    cases.push_back(open_wall(fmt::format("radius {:g} m; the scene is 1 m", radius_m), radius_m));
  }
  for (const double radius_roi : {1.0, 1e6}) {
    cases.push_back(open_wall(fmt::format("radius of {:g} diagonals", radius_roi), 0, radius_roi));
  }
  cases.push_back(ridges_as_limit("ridges, radius 1e-4 m: a thirtieth of a pixel", 1e-4, 0, 0.01));
  cases.push_back(ridges_as_limit("ridges, radius 0.01 m", 0.01, 0.02, 1));
  cases.push_back(ridges_as_limit("ridges, radius 0.03 m", 0.03, 0.05, 1));
  cases.push_back(ridges_as_limit("ridges, radius 10 m; the scene is 1 m", 10, 0, 0.01));
  cases.push_back(drawn_true(kGroup, "8 radii, 256 samples, larger than the scene", [] {
    Drawing drawing{small_display(), sphere_in_box(small_roi()), small_roi(), {}};
    drawing.settings.mutable_ao()->set_radius_m(10);
    drawing.settings.mutable_ao()->set_radii(8);
    drawing.settings.mutable_ao()->set_samples(256);
    return drawing;
  }));
}

}  // namespace lfd::bench
