// Ambient occlusion with radii from nothing to beyond the scene.
#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "bench/reference/scene_maker.h"
#include "bench/stability/drawing.h"
#include "bench/stability/groups.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "ambient occlusion";

// A wall across the whole picture, slanted: with samples in pairs that mirror each other exactly half of them are
// hidden, whatever the radius, and the curve makes that 0 (design ambient-occlusion, "Sample sets").
Drawing wall(const std::string& field, double radius) {
  const RegionOfInterest roi = small_roi();
  reference::SceneMaker maker;
  maker.add_quad({-0.6F, -0.6F, -0.14F}, {0.6F, -0.6F, 0.02F}, {0.6F, 0.6F, 0.02F}, {-0.6F, 0.6F, -0.14F},
                 maker.add_material({}));
  Drawing drawing{small_display(), maker.data(), roi, {}};
  auto& ao = *drawing.settings.mutable_ao();
  ao.set_point_symmetric(true);
  ao.mutable_blur()->set_enabled(false);
  if (field == "radius_m") ao.set_radius_m(radius);
  if (field == "radius_roi") ao.set_radius_roi(radius);
  return drawing;
}

StabilityCase open_wall(std::string name, const std::string& field, double radius) {
  // Samples beyond the border of the picture count as open, never as hidden; one of the 8 samples may be rounded to the
  // wrong side at a pixel.
  constexpr double kMean = 0.01;
  return {kGroup, std::move(name), fmt::format("a flat wall is open: mean at most {}; all finite", kMean),
          [field, radius](const gl::Context& context) -> Outcome {
            const auto drawn = draw(context, wall(field, radius));
            if (!drawn) return {"error: " + drawn.error().message(), 0, false};
            const std::string got = fmt::format("mean {:.2g}, largest {:.2g}", drawn->mean_ao, drawn->largest_ao);
            return {drawn->fault.empty() ? got : drawn->fault, drawn->mean_ao,
                    drawn->fault.empty() && drawn->mean_ao <= kMean};
          }};
}

}  // namespace

void add_occlusion_cases(StabilityCases& cases) {
  cases.push_back(open_wall("radius 0: the default share of the diagonal", "radius_m", 0));
  for (const double radius_m : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    cases.push_back(open_wall(fmt::format("radius {:g} m; a pixel is 0.003 m", radius_m), "radius_m", radius_m));
  }
  for (const double radius_m : {1e-8, 1e-9, 1e-30, 1e-300}) {
    cases.push_back(drawing_refused(kGroup,
                                    fmt::format("radius {:g} m: less than a rounding of the positions", radius_m),
                                    "ao: the radius", [radius_m] { return wall("radius_m", radius_m); }));
  }
  for (const double radius_m : {1.0, 1e3, 1e9, 1e15}) {
    cases.push_back(open_wall(fmt::format("radius {:g} m; the scene is 1 m", radius_m), "radius_m", radius_m));
  }
  for (const double radius_roi : {1.0, 1e6}) {
    cases.push_back(open_wall(fmt::format("radius of {:g} diagonals", radius_roi), "radius_roi", radius_roi));
  }
  cases.push_back(drawn_true(kGroup, "8 radii, 256 samples, larger than the scene", [] {
    Drawing drawing{small_display(), sphere_in_box(small_roi()), small_roi(), {}};
    drawing.settings.mutable_ao()->set_radius_m(10);
    drawing.settings.mutable_ao()->set_radii(8);
    drawing.settings.mutable_ao()->set_samples(256);
    return drawing;
  }));
}

}  // namespace lfd::bench
