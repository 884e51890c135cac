// What a fit has found, as JSON for programs and as a table for people.
#pragma once

#include <string>

#include "calibration/fit/fit.h"

namespace lfd {

// Numbers have as many digits as it takes to read the same doubles back.
std::string fit_json(const FittedDisplay& fitted, const Observations& observations);

// A line for each module, for what is common to all, and for each outlier.
std::string fit_table(const FittedDisplay& fitted, const Observations& observations);

}  // namespace lfd
