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
  // What is measured, and by what.
  struct Subject {
    const ShownScene& scene;
    std::uint32_t module;
    const std::vector<Rung>& rungs;
    const std::string& renderer;  // driver and device
  };

  // Drawn by this program with as many frames.
  KeptMeasurements(const Subject& subject, const MeasureOptions& options);

  // Absent where there is none, or a damaged one.
  std::optional<std::vector<Measurement>> read() const;
  Status write(const std::vector<Measurement>& measurements) const;

 private:
  std::filesystem::path times_, pictures_;
  std::string key_;
  std::size_t rungs_ = 0;
};

}  // namespace lfd::bench
