// What a check gathers of one module before it becomes shares and quantiles.
#pragma once

#include <cstddef>
#include <vector>

#include "calibration/check/check.h"

namespace lfd {

struct ModuleSamples {
  std::vector<double> round_trip_px;   // one for each image point on the screen
  std::vector<double> conditions;      // one for each point of the box that has an image
  std::vector<double> pixel_widths_m;  // on the screen
  std::size_t image_points = 0, unmapped = 0;
  std::size_t derivatives = 0, mirrored = 0, near_singular = 0;
  double folded = 0, incomplete = 0;  // shares, see MapNumbers
  std::vector<bool> lit;              // places of the screen, see CalibrationReport::lit_by

  void append(const ModuleSamples& other);  // all but folded, incomplete and lit
};

ModuleSamples sample_module(const DisplayCalibration& display, const ModuleCalibration& module, double half_depth_m,
                            const CheckSampling& sampling);

// Reorders the samples.
MapNumbers numbers_of(ModuleSamples& samples);

// Reorders `values`; 0 where there is none.
double quantile(std::vector<double>& values, double share);

double share_of(std::size_t part, std::size_t whole);

}  // namespace lfd
