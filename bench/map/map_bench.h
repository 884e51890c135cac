// Position error against run time, for every way of drawing through the calibrated map.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "bench/common/spread.h"
#include "bench/map/map_variants.h"
#include "bench/reference/truth.h"
#include "proto/deployment_file.h"

namespace lfd::gl {
class Context;
}

namespace lfd::bench {

struct MapBenchOptions {
  std::filesystem::path deployment;
  DeploymentOverrides overrides;
  std::vector<std::filesystem::path> scenes;  // glTF files, one after the other; empty: the deployment's scene
  std::vector<std::uint32_t> modules;         // empty: the middle one, the first and the last
  int frames = 20;                            // of each variant, in turn
  int gpu = -1;                               // of `lfd-rendernode --list-gpus`; -1: the first that works
};

// The table that stands for a measured map.
struct MeasuredTable {
  int columns = 0;
  double error_px = 0;  // largest distance from the map (rendernode/geometry/warp_table.h)
};

// One variant on one module of one scene.
struct MapRow {
  std::string scene, variant;
  std::uint32_t module = 0;
  std::uint64_t triangles = 0;  // after cutting and subdivision
  double build_ms = 0;          // geometry and tables, once, on the CPU
  std::optional<MeasuredTable> table;
  Spread gpu_ms, wall_ms;        // over frames: z prepass and G-buffer by timer queries; submitted to done
  Spread gpu_ratio, wall_ratio;  // to plain vertices in the same round
  double roi_diagonal_m = 0;
  reference::Truth truth;
};

struct MapTable {
  std::string display;
  ImageSize image;
  std::string renderer;
  bool is_software = false;
  std::string version;
  int frames = 0;
  std::vector<MapRow> rows;  // scenes in turn, their modules, and their variants in the order of map_variants()

  std::vector<std::string> scenes() const;  // each once
};

// What a way of drawing has to keep on every module of every scene, and how much of plain vertices' time it may take on
// the first scene.
struct MapBounds {
  double percent_999 = 1e-4, max = 1e-3, mismatch_share = 5e-4, ratio = 2;
};

// One line for each bound on errors that a picture misses, with both numbers.
std::vector<std::string> missed_bounds(const reference::Truth& truth, const MapBounds& bounds = {});

// The time that counts, over that of plain vertices: of the GPU by timer queries; on a rasteriser that works on the
// CPU, where these leave vertices out, of the wall clock.
const Spread& cost_ratio(const MapTable& table, const MapRow& row);

// One line for each bound that a variant misses, with scene, module and both numbers. None: it may be the default.
std::vector<std::string> missed_bounds(const MapTable& table, const std::string& variant, const MapBounds& bounds = {});

// Loads, times, judges; progress goes to the log. Errors: files, numbers that do not fit, the driver.
Result<MapTable> map_bench(const MapBenchOptions& options);
Result<MapTable> map_bench(const gl::Context& context, const MapBenchOptions& options);

std::string text_of(const MapTable& table);
std::string csv_of(const MapTable& table);
std::string json_of(const MapTable& table);
// Error (99.9 %) over time, both logarithmic, one picture for all modules of a scene.
std::string svg_of(const MapTable& table, const std::string& scene);

}  // namespace lfd::bench
