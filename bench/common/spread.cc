// Percentiles of measured values.
#include "bench/common/spread.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lfd::bench {

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(std::max(std::ceil(share * count), 1.0)) - 1];
  };
  return {std::accumulate(values.begin(), values.end(), 0.0) / count, at(0.5), at(0.05), at(0.95)};
}

}  // namespace lfd::bench
