// Render settings with every default filled in and every number checked.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "calibration/maps/ideal.h"
#include "calibration/spaces/roi.h"
#include "proto/occlusion/method.h"
#include "proto/pattern.h"
#include "proto/scene.pb.h"
#include "proto/settings.pb.h"

namespace lfd {

enum class AoBlur { kGaussian, kGeometry };
enum class AoTarget { kAmbientLight, kWholeColor };

// Ambient occlusion; the meaning of each number: settings.proto.
struct AoSettings {
  bool enabled = true;
  const occlusion::Method* method = &occlusion::default_method();
  std::vector<double> parameters = occlusion::fallbacks(*method);  // in the method's order
  double radius_m = 0;                                             // 0: radius_roi x ROI diagonal
  double radius_roi = 0.03;
  int samples = method->samples;  // 0: the method takes none
  SampleGenerator generator = SampleGenerator::kPoissonDisk;
  int radii = 1;
  std::uint32_t seed = 0;
  occlusion::Curve curve = method->curve;
  bool blur_enabled = true;
  AoBlur blur = AoBlur::kGaussian;  // kGeometry where modules share, see settings.proto
  double blur_sigma_px = 1.5;       // of kGaussian
  int blur_taps = 2;                // of kGeometry, on each side
  bool half_resolution = false;
  bool bent_normals = false;
  int guard_band_px = 0;
  int least_samples = 0;      // 0: as many everywhere
  int shared_neighbours = 0;  // to each side
  bool shared_open_air = false;
  double budget_ms = 0;          // 0: none
  bool explicit_method = false;  // the message names one: it is taken whatever the budget
  AoTarget target = AoTarget::kAmbientLight;
  bool operator==(const AoSettings&) const = default;

  // One of the method's parameters; it has one of that name.
  double& parameter(std::string_view name);
  double parameter(std::string_view name) const;

  // Whether the node chooses the method by its own times.
  bool is_chosen_by_budget() const { return budget_ms > 0 && !explicit_method; }

  // What every pixel turns for itself; empty where the method takes no samples.
  std::vector<glm::vec4> sample_set() const;

  // The world-space radius for this region of interest.
  double radius_in_world_m(double roi_diagonal_m) const {
    return radius_m > 0 ? radius_m : radius_roi * roi_diagonal_m;
  }
};

// "off", "Gaussian, sigma 1.5 px", "by geometry, 2 taps a side".
std::string blur_text(const AoSettings& ao);

struct RenderSettings {
  AoSettings ao;
  glm::vec3 background{0};  // linear
  bool plan = true;         // leave out what the scene does not need
  double subdivision_px = 0.02;
  std::optional<double> near_z_m, far_z_m;
  bool unlit = false;
  bool interpolated_position = false;
  double tessellation_px = 0;  // 0: none
  int warp_level = 0;          // 0: chosen from the error
  PatternSettings pattern;     // shown instead of the scene
  bool operator==(const RenderSettings&) const = default;
};

// Errors name the field: "ao.samples: 1000; 1 to 256 are possible", "ao.parameter \"shell\": hbao has directions, steps
// and bias".
Result<RenderSettings> read_settings(const proto::RenderSettings& message);

// Refuses a radius of ambient occlusion that is nothing beside the region of interest: less than kLeastAoRadius of its
// diagonal, at which the roundings of stored positions decide what is hidden (measured by bench/stability).
inline constexpr double kLeastAoRadius = 1e-7;
Status check_radius(const AoSettings& ao, const RegionOfInterest& roi);

// A complete region of interest (every box given). Errors name the field.
Result<RegionOfInterest> read_roi(const proto::RegionOfInterest& message);
proto::RegionOfInterest write_roi(const RegionOfInterest& roi);

// Fills what `message` leaves out: the world box from the scene's bounds, the physical box by uniform scale to fit the
// screen (fit_to_screen of calibration/spaces/roi.h). A missing orientation is unturned.
Result<RegionOfInterest> complete_roi(const proto::RegionOfInterest& message, Point3<World> low, Point3<World> high,
                                      double screen_width_m, double screen_height_m);
// The same with the bounds that the scene says it has.
Result<RegionOfInterest> complete_roi(const proto::RegionOfInterest& message, const proto::Scene& scene,
                                      ScreenSize screen);

// Writes a box of exactly six numbers: centre x, y, z and edge lengths x, y, z.
void set_box(proto::Vector& centre, proto::Vector& size, std::span<const double> numbers);

}  // namespace lfd
