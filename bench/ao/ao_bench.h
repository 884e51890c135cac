// Error against run time, for every method of ambient occlusion and its parameters.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/ao/ladder.h"
#include "bench/common/spread.h"
#include "calibration/spaces/pixel.h"
#include "proto/occlusion_front.pb.h"

namespace lfd::gl {
class Context;
}

namespace lfd::bench {

struct AoBenchOptions {
  std::vector<std::filesystem::path> deployments;  // each a scene on a display
  std::vector<std::filesystem::path> scenes;       // glTF files, shown by the first deployment too
  std::optional<std::filesystem::path> display;    // instead of the deployments'
  std::filesystem::path out;                       // its folder `cache` keeps rays and pictures
  bool resume = false;                             // takes drawn pictures from there too, not only rays
  std::optional<ImageSize> size;                   // of the modules' images; absent: the displays' own
  int frames = 5;                                  // of each rung, in turn
  int rays = 1024;                                 // of the reference, for each pixel
  std::vector<double> radii{0.01, 0.04, 0.16};     // shares of the ROI diagonal
  std::vector<std::uint32_t>
      modules;  // the first counts as the middle; empty: the middle one, the first and, for sharing, the last
  std::vector<std::string> methods;                                                 // empty: all
  std::vector<ImageSize> sizes{{256, 192}, {512, 384}, {1024, 768}, {2048, 1536}};  // of the scaling; empty: none
  std::vector<int> module_counts{1, 2, 4, 8, 16, 32, 64};  // of the sharing; more than the display has are left out
  int gpu = -1;                                            // of `lfd-rendernode --list-gpus`; -1: the first that works
};

// Where a module stands: in the middle of the display, at its edge, or at its other edge, where sharing alone is looked
// at.
enum class PlaceKind { kMiddle, kEdge, kOtherEdge };
const char* name_of(PlaceKind place);  // "middle", "edge", "other edge"

// How near a picture of occlusion comes to the rays, on openness 1 - ao.
struct AoJudgement {
  double mae = 0, ssim = 0, bias = 0;  // bias: mean of picture minus rays
  double mae_uniform = 0;              // against rays that count every direction alike
  double mae_silhouette = 0;           // over pixels near silhouettes alone
  double inconsistent = 0;             // share of surface points that the next module shows otherwise (consistency.h)
};

struct AoFit {
  occlusion::Curve curve{};  // fitted on the other scenes at this radius
  AoJudgement judged;
};

// One rung at one place with one radius.
struct AoRow {
  std::string scene, display;
  std::uint32_t module = 0;
  PlaceKind place = PlaceKind::kMiddle;
  ImageSize image;
  double radius_share = 0, radius_m = 0, radius_px = 0;  // of the ROI diagonal; world; mean over the picture
  Rung rung;
  std::string blur;
  TapCount taps;
  int layers = 0;  // modules drawn together
  std::size_t frames = 0;
  Spread occlusion_ms, blur_ms, ratio;  // of one module; ratio: to `sphere` as it comes, in the same round
  occlusion::Curve curve{};             // the method's own, or the rung's
  AoJudgement judged;
  std::optional<AoFit> fitted;        // absent where there is no other scene
  occlusion::Curve curve_over_all{};  // fitted on all scenes and radii
  double mae_over_all = 0;            // with one fitted on the other scenes and all radii; unfitted where there is none
  std::size_t pixels = 0, shared_points = 0;

  bool is_middle() const { return place == PlaceKind::kMiddle; }
  double total_ms() const { return occlusion_ms.median + blur_ms.median; }
};

// A place, whatever is drawn there.
struct AoPlaceFacts {
  std::string scene, display;
  std::uint32_t module = 0;
  PlaceKind place = PlaceKind::kMiddle;
  ImageSize image;
  double radius_share = 0, radius_m = 0, radius_px = 0;
  double mae_of_none = 0;  // of a picture without occlusion
  double cast_ms = 0;      // of the reference, for all radii
};

// Default settings of one method, where radius or resolution grow.
struct ScalingRow {
  std::string method;
  double radius_share = 0, radius_px = 0;
  ImageSize image;
  double occlusion_ms = 0, ratio = 0, mae = 0;  // ratio: to `sphere` at the same radius and size
};

// Sharing as the modules of a node grow.
struct SharingRow {
  int modules = 0;
  double alone_ms = 0, shared_ms = 0;  // of one module: occlusion without sharing, and with it
};

struct AoTable {
  std::string renderer;
  bool is_software = false;
  std::string version;
  int rays = 0;
  std::vector<AoPlaceFacts> places;
  std::vector<AoRow> rows;
  std::vector<ScalingRow> by_radius, by_size;
  std::vector<SharingRow> sharing;

  std::vector<std::string> scenes() const;  // each once
  double middle_radius() const;             // of those that were drawn, a share of the ROI diagonal; 0: none was
};

// With the fitted curve, or where there is none unfitted.
const AoJudgement& fitted_or_not(const AoRow& row);

// Of a scene's name, for files: up to its first point or blank.
std::string stem_of(const std::string& scene);

// Refuses numbers that are out of range and methods that are not there.
Status check_options(const AoBenchOptions& options);

// Loads, casts, draws, judges; progress goes to the log. Errors: files, numbers that do not fit, the driver.
Result<AoTable> ao_bench(const AoBenchOptions& options);
Result<AoTable> ao_bench(const gl::Context& context, const AoBenchOptions& options);

// Rungs of which none is both faster and more accurate, over all places that have them: by mean time ratio, the
// cheapest first. Curves are those fitted on all scenes.
proto::OcclusionFront front_of(const AoTable& table);

std::string text_of(const AoTable& table);
std::string csv_of(const AoTable& table);
std::string json_of(const AoTable& table);
std::string front_text_of(const AoTable& table);
// Error over time, both logarithmic, with the Pareto front: the middle module, the middle radius.
std::string svg_of(const AoTable& table, const std::string& scene);

}  // namespace lfd::bench
