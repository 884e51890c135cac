// Times the frames of one module without and with ambient occlusion, and judges what was timed (Doronin et al., WSCG
// 2017, section 7).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "bench/frame/frame_error.h"
#include "bench/frame/pass_times.h"
#include "calibration/spaces/pixel.h"
#include "proto/deployment_file.h"

namespace lfd::gl {
class Context;
}

namespace lfd::bench {

struct FrameBenchOptions {
  std::filesystem::path deployment;
  DeploymentOverrides overrides;
  std::optional<proto::RegionOfInterest> roi;  // instead of the deployment's
  std::optional<std::uint32_t> module;         // absent: the middle one, number (modules / 2)
  int frames = 1000;                           // of each kind, without and with
  int gpu = -1;                                // of `lfd-rendernode --list-gpus`; -1: the first that works
  AoSubset ao_subset;
};

// What was drawn, and by what.
struct FrameSubject {
  std::string scene;
  std::size_t faces = 0, textures = 0;  // of the scene as it was loaded
  std::uint64_t drawn_triangles = 0;    // after cutting and subdivision
  std::string display;
  std::uint32_t module = 0, modules = 0;
  ImageSize image;
  double roi_diagonal_m = 0;
  double ao_radius_m = 0;  // R, in the world
  AoSettings ao;
  std::string renderer;          // driver and device
  std::string version, commit;   // commit: "unknown" where the build knew none
  double geometry_build_ms = 0;  // once, before the first frame, on the CPU
};

struct FrameTable {
  FrameSubject subject;
  PassTimes times;
  FrameError error;  // of the frame with ambient occlusion
};

// Refuses a module or a GPU that is not there; a deployment that cannot be read is left to frame_bench().
Status check_options(const FrameBenchOptions& options);

// Loads, times, judges; progress goes to the log. Errors: files, numbers that do not fit, the driver.
Result<FrameTable> frame_bench(const FrameBenchOptions& options);

// The same with a context that is current on this thread; `gpu` is not looked at.
Result<FrameTable> frame_bench(const gl::Context& context, const FrameBenchOptions& options);

}  // namespace lfd::bench
