// What lfd-calibrate check was asked, and its answer as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/check/acceptance.h"

namespace lfd {

struct CheckOptions {
  std::string file;
  std::optional<double> depth_m;
  std::vector<double> roi;  // centre and edge lengths of a box in physical space, m; empty: around the screen
  AcceptanceLimits limits;
  bool json = false;
  bool per_module = false;
  std::string plot_folder;  // empty: no pictures
  std::optional<int> plot_module;
};

// One object with everything the check found; keys are stable, null stands for numbers that are infinite or absent.
std::string check_json(const DisplayCalibration& display, const CalibrationReport& report,
                       const AcceptanceLimits& limits);

}  // namespace lfd
