// Bad numbers in files of observations.
#include <array>
#include <cmath>

#include "base/log.h"
#include "bench/stability/file_fields.h"
#include "bench/stability/groups.h"
#include "calibration/fit/observations.h"

namespace lfd::bench {
namespace {

bool is_finite(const Observation& o) {
  return std::isfinite(o.in_image.x) && std::isfinite(o.in_image.y) && std::isfinite(o.on_screen.x) &&
         std::isfinite(o.on_screen.y) && o.sigma_px > 0 && std::isfinite(o.sigma_px);
}

// Empty, or what is wrong with observations that were read.
std::string harm_of(const Observations& observations) {
  for (const Observation& o : observations.points) {
    if (!is_finite(o)) return "a number that is not finite";
    if (o.module < 0) return fmt::format("module {}", o.module);
  }
  const auto again = parse_observations(print_observations(observations), observations.source);
  if (!again) return "what was read cannot be written: " + again.error().message();
  return again->points == observations.points ? "" : "what was read changes by writing";
}

constexpr std::array kColumns{"module", "u", "v", "s", "y", "sigma"};
constexpr std::array kSound{"0", "3.5", "4.5", "0.1", "-0.1", "0.2"};

StabilityCase observation_case(std::size_t column) {
  const std::string name = kColumns[column];
  const auto read = [column](const std::string& value) -> Result<std::string> {
    std::string text = "module,u,v,s,y,sigma\n";
    for (std::size_t i = 0; i < kSound.size(); ++i)
      text += (i > 0 ? "," : "") + (i == column ? value : std::string(kSound[i]));
    LFD_TRY(const Observations observations, parse_observations(text + "\n", "observations.csv"));
    return harm_of(observations);
  };
  return field_case(kTextGroup, {"observations: " + name,
                                 kSound[column],
                                 {kBadTexts.begin(), kBadTexts.end()},
                                 {name},
                                 "observations.csv:2: " + name + ": ",
                                 read});
}

}  // namespace

void add_text_field_cases(StabilityCases& cases) {
  for (std::size_t column = 0; column < kColumns.size(); ++column) cases.push_back(observation_case(column));
}

}  // namespace lfd::bench
