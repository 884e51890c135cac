// Measurements in files, so that a bench that was ended goes on where it was.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/ao/measure.h"

namespace lfd::bench {

class KeptMeasurements {
 public:
  // Of these rungs at this place, drawn by this program (its commit) with as many frames.
  KeptMeasurements(const std::filesystem::path& cache, const ShownScene& scene, std::uint32_t module,
                   const std::vector<Rung>& rungs, const MeasureOptions& options);

  // Absent where there is none, or a damaged one.
  std::optional<std::vector<Measurement>> read() const;
  Status write(const std::vector<Measurement>& measurements) const;

 private:
  std::filesystem::path times_, pictures_;
  std::string key_;
  std::size_t rungs_ = 0;
};

}  // namespace lfd::bench
