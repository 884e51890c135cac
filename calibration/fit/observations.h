// What a camera saw: where points of modules' images lie on the screen; read from and written as CSV.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "calibration/spaces/spaces.h"

namespace lfd {

struct Observation {
  int module = 0;
  PixelPoint in_image;    // px
  ScreenPoint on_screen;  // m
  double sigma_px = 1;    // standard deviation of in_image along each axis, where the file gives one
  std::size_t line = 0;   // of the file, from 1
  bool operator==(const Observation&) const = default;
};

struct Observations {
  std::string source;      // the file's name, for messages
  bool has_sigma = false;  // without: how good the observations are is to be found from themselves
  std::vector<Observation> points;
  bool operator==(const Observations&) const = default;

  // "FILE:LINE"
  std::string place_of(const Observation& observation) const;
};

// Beyond these a file is a mistake.
inline constexpr std::size_t kObservationFileLimit_bytes = std::size_t{256} << 20;
inline constexpr std::size_t kMaxObservations = 1'000'000;
inline constexpr double kMostSigma_px = 1e6, kLeastSigma_px = 1e-6;

// A header with the columns module, u, v, s, y and, if known, sigma, in any order, then a line for each observation.
// Errors name source, line and field: a column that is missing, unknown or there twice; another number of fields; what
// is no number, not finite, out of range; too many lines.
Result<Observations> parse_observations(std::string_view text, std::string_view source);

// The same from a file of at most kObservationFileLimit_bytes.
Result<Observations> load_observations(const std::string& path);

// parse_observations of this gives equal observations, but for source and line numbers. Lines are written in the order
// of `points`.
std::string print_observations(const Observations& observations);

}  // namespace lfd
