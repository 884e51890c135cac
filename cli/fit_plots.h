// Pictures of a fit: the residuals of every module.
#pragma once

#include <filesystem>

#include "calibration/fit/fit.h"

namespace lfd {

// Writes residuals-module-NNN.svg for each module into the folder, which it makes. Errors: files that cannot be
// written.
Status write_fit_plots(const std::filesystem::path& folder, const FittedDisplay& fitted,
                       const Observations& observations);

}  // namespace lfd
