// How module images travel: what each encoding loses and takes, and how much of the message library's throughput the
// images channel keeps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "bench/common/spread.h"
#include "bench/stream/throughput.h"
#include "calibration/spaces/pixel.h"
#include "proto/deployment_file.h"

namespace lfd::gl {
class Context;
}

namespace lfd::bench {

struct StreamBenchOptions {
  std::filesystem::path deployment;
  DeploymentOverrides overrides;
  std::vector<std::filesystem::path> scenes;  // glTF files, one after the other; empty: the deployment's scene
  std::vector<std::uint32_t> modules;         // empty: the middle one, the first and the last
  int repeats = 5;                            // of each encoding of each image
  ThroughputOptions throughput;
  int gpu = -1;  // of `lfd-rendernode --list-gpus`; -1: the first that works
};

// One encoding of one buffer of all modules of a scene.
struct CodecRow {
  std::string scene, buffer, codec;  // "color", "jpeg 90"
  int images = 0;
  std::uint64_t pixel_bytes = 0, bytes = 0;  // of all of them
  Spread encode_ms, decode_ms;               // of one image, on one thread
  // Of the worst module, colours against raw ones (peak 255); absent where nothing is lost.
  std::optional<double> psnr_db;

  double ratio() const { return static_cast<double>(pixel_bytes) / static_cast<double>(bytes); }
};

struct StreamTable {
  std::string display, renderer, version;
  ImageSize image;
  std::vector<std::uint32_t> modules;
  std::vector<CodecRow> rows;  // scenes in turn
  std::vector<ThroughputRow> throughput;

  std::vector<std::string> scenes() const;  // each once
};

// At least so much of what the message library alone reaches.
inline constexpr double kLeastThroughputRatio = 0.8;

// Measures; progress goes to the log. Errors: files, numbers that do not fit, the driver.
// Call it before any thread starts: throughput is measured between two processes, and the other one is a fork.
Result<StreamTable> stream_bench(const StreamBenchOptions& options);

// The encodings alone, with a context that is current on this thread.
Result<StreamTable> codec_bench(const gl::Context& context, const StreamBenchOptions& options);

std::string text_of(const StreamTable& table);
std::string csv_of(const StreamTable& table);
// Empty where the bounds are kept.
std::string missed_bound(const StreamTable& table);
// PSNR and time over bytes, of the colours of a scene.
std::string svg_of(const StreamTable& table, const std::string& scene);

}  // namespace lfd::bench
