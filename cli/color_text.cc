// Ranges of the numbers of all modules.
#include "cli/color_text.h"

#include <algorithm>
#include <limits>

#include "base/log.h"

namespace lfd {
namespace {

// The least and the largest of what is added; something is.
class Range {
 public:
  void add(double value) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  std::string text() const {
    return low_ == high_ ? fmt::format("{:.4g}", low_) : fmt::format("{:.4g} to {:.4g}", low_, high_);
  }

 private:
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

}  // namespace

std::string color_text(const DisplayCalibration& display) {
  Range gain, black, gamma;
  int modules = 0, gammas = 0, tables = 0;
  for (const ModuleCalibration& module : display.modules) {
    if (!module.color) continue;
    ++modules;
    for (const glm::dvec3& node : module.color->gain.node) {
      for (int c = 0; c < 3; ++c) gain.add(node[c]);
    }
    for (int c = 0; c < 3; ++c) black.add(module.color->black_level[c]);
    for (const TransferCurve& curve : module.color->curve) {
      if (std::holds_alternative<TableCurve>(curve)) ++tables;
      const auto* power = std::get_if<GammaCurve>(&curve);
      if (power == nullptr) continue;
      ++gammas;
      gamma.add(power->gamma);
    }
  }
  if (modules == 0) return "sRGB";
  std::string text = fmt::format("{} of {} modules corrected: gain {}, black level {}", modules, display.modules.size(),
                                 gain.text(), black.text());
  if (gammas > 0) text += fmt::format(", gamma {}", gamma.text());
  if (tables > 0) text += fmt::format(", {} measured curves", tables);
  return text;
}

}  // namespace lfd
