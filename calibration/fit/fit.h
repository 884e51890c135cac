// A display's calibration from observations: pinholes and the screen at once, then residual grids.
//
// How well. Observations with noise of standard deviation n along each axis, outliers among them, give back maps whose
// error at held-out points is below 1.5 n: of pinholes everywhere; of grids, which follow the noise of the few
// observations at a border, as root mean square (below 0.7 n) and at 98 of 100 points of each module, below 4 n at all,
// as far as something was observed within one spacing of the observations. In areas that nobody saw a grid is a guess.
// (24 x 18 observations of each module, warps of 2 px that no pinhole has, planar and curved screens.)
//
// What the observations fix, and what they cannot. (s, y) are measured on the screen, so they are the screen's
// coordinates: the camera's frame needs no parameters. A similarity of it, applied to all emitters as well, changes no
// image; on a planar screen any affine change can be taken up by the modules' own poses and focal lengths, so it cannot
// be observed either. The one thing about the screen that observations tell is the curvature of a curved one: it is
// common to all modules, and fitted (its logarithm, standard deviation 0.2 about the start's; five of them away the fit
// is refused), unless some module needs a grid: what warps of several modules have in common looks like curvature, so
// that the start's is held then. A planar screen stays planar. Of each pinhole a plane determines eight combinations
// well, its lens about five more; two (roughly: how far the projector stands, and where along its axis) only through
// the lens. Priors about the start decide these: standard deviations in pinhole_family.h. They pull on everything else
// by far less than the observations' noise.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/display.h"
#include "calibration/fit/observations.h"

namespace lfd {

struct FitOptions {
  // Standard deviation of the start's emitters along each axis, m, > 0; absent: 0.5 % of their distance from the
  // screen.
  std::optional<double> emitter_sd_m;
  bool residual_grids = true;  // false: all modules stay pinholes
};

// Distances in the image between where observed screen points are seen and where the map says, px; outliers left out.
struct ResidualSummary {
  double median_px = 0, quantile_99_px = 0, max_px = 0;
};

struct ModuleFit {
  std::size_t observations = 0, outliers = 0;
  ResidualSummary before;  // of the start, as a pinhole
  ResidualSummary after;
  double noise_px = 0;  // robust standard deviation of the residuals after, along each axis
  bool is_grid = false;
  // Root mean square of residuals held out of the smoothing: of the pinhole, and with the residual field. Absent where
  // there are too few observations to tell, and where no grid was asked for.
  std::optional<double> held_out_pinhole_px, held_out_field_px;
  std::vector<std::string> held_by_start;  // parameters about which the start says more than the observations
};

struct Outlier {
  int module = 0;
  std::size_t line = 0;  // of the observations' file
  double residual_px = 0;
  bool operator==(const Outlier&) const = default;
};

struct FittedDisplay {
  DisplayCalibration display;  // of the start's name, screen and optics, but for the fitted radius
  std::vector<ModuleFit> modules;
  std::vector<Outlier> outliers;  // ascending by line
  double radius_sd_m = 0;         // of a curved screen's radius; 0: planar, or held
  bool radius_is_held = false;    // a curved screen has the start's radius, since some module needs a grid
};

// An observation is an outlier beyond so many standard deviations (normal errors get there once in 10^7), and never
// below kLeastOutlier_px.
inline constexpr double kOutlierSigmas = 6;
inline constexpr double kLeastOutlier_px = 0.01;

// The order of the observations makes no difference. Errors begin with the observations' source, and name line or
// module: those of observations_by_module() and determined_by(), a start that cannot see what was observed. An error of
// the options names them.
Result<FittedDisplay> fit_display(const DisplayCalibration& start, const Observations& observations,
                                  const FitOptions& options = {});

}  // namespace lfd
