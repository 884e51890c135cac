// Observations as a camera would make them of a known display: noise, outliers, areas it cannot see.
#pragma once

#include <cstdint>

#include "calibration/display.h"
#include "calibration/fit/observations.h"

namespace lfd {

struct SimulationOptions {
  double noise_px = 0.1;             // standard deviation of the image position along each axis
  double outliers = 0.01;            // share of the observations whose image position is displaced by 10 to 40 px
  double missing = 0.05;             // share of each module's image that is not seen: a rectangle or a disc
  int points_u = 24, points_v = 18;  // per module, evenly over its image
  bool write_sigma = false;          // tell noise_px as each observation's sigma
  std::uint64_t seed = 1;
};

struct SimulatedObservations {
  Observations observations;          // line numbers are those of print_observations()
  std::vector<std::size_t> outliers;  // indices into observations.points, ascending
};

// Points that the display's map does not show on its screen are left out. Noise and displacement never leave the
// image; where it is too small for a displacement, there is none.
// Equal options give equal observations. Errors name the option that is out of range: noise below 0 or above a quarter
// of the image, shares beside [0, 1], fewer than 2 x 2 points or too many, a sigma of noise 0.
Result<SimulatedObservations> simulate_observations(const DisplayCalibration& display,
                                                    const SimulationOptions& options);

}  // namespace lfd
