// How measured times are spread: mean, median, and the range that nine of ten lie in.
#pragma once

#include <vector>

namespace lfd::bench {

// Percentiles are by nearest rank. All in the unit of the values.
struct Spread {
  double mean = 0, median = 0, percent_5 = 0, percent_95 = 0;
};

// All 0 where there are no values.
Spread spread_of(std::vector<double> values);

}  // namespace lfd::bench
