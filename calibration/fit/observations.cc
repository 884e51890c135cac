// CSV of observations: one pass over the text, every number checked where it stands.
#include "calibration/fit/observations.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/file.h"
#include "base/log.h"
#include "calibration/display.h"

namespace lfd {
namespace {

enum Column { kModule, kU, kV, kS, kY, kSigma, kColumns };
constexpr std::array<const char*, kColumns> kNames{"module", "u", "v", "s", "y", "sigma"};
constexpr double kMostPlace_px = 1e6;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// The part before the next `separator`, which is taken off `rest`; absent once all is taken.
std::optional<std::string_view> next_part(std::optional<std::string_view>& rest, char separator) {
  if (!rest) return std::nullopt;
  const std::size_t end = rest->find(separator);
  const std::string_view part = rest->substr(0, end);
  if (end == rest->npos) {
    rest.reset();
  } else {
    rest->remove_prefix(end + 1);
  }
  return part;
}

// As much of a foreign text as a message can bear.
std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string shown(text.substr(0, kMost));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  return '"' + shown + (text.size() > kMost ? "..." : "") + '"';
}

// The order of the columns: which is the i-th of a line.
Result<std::vector<Column>> parse_header(std::string_view line) {
  std::vector<Column> order;
  std::optional<std::string_view> rest = line;
  while (const auto part = next_part(rest, ',')) {
    const std::string_view name = trimmed(*part);
    const auto* const known = std::find(kNames.begin(), kNames.end(), name);
    if (known == kNames.end()) {
      return Error(
          fmt::format("column {}: unknown; the header names module, u, v, s, y and, if known, sigma", quoted(name)));
    }
    const auto column = static_cast<Column>(known - kNames.begin());
    if (std::find(order.begin(), order.end(), column) != order.end()) {
      return Error(fmt::format("column {}: is there twice", quoted(name)));
    }
    order.push_back(column);
  }
  for (int column = kModule; column < kSigma; ++column) {
    if (std::find(order.begin(), order.end(), column) == order.end()) {
      return Error(fmt::format("column \"{}\": is missing", kNames[static_cast<std::size_t>(column)]));
    }
  }
  return order;
}

Result<double> parse_number(std::string_view text) {
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  double number = 0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (failure == std::errc::result_out_of_range) return Error(fmt::format("{}: is out of range", quoted(text)));
  if (failure != std::errc() || end != digits.data() + digits.size()) {
    return Error(fmt::format("{}: is not a number", quoted(text)));
  }
  if (!std::isfinite(number)) return Error(fmt::format("{}: must be finite", quoted(text)));
  return number;
}

Status put(Observation& to, Column column, double value) {
  const auto within = [&](double low, double high) -> Status {
    if (value >= low && value <= high) return {};
    return Error(fmt::format("{}: must be within {:g} and {:g}", value, low, high));
  };
  switch (column) {
    case kModule:
      LFD_TRY_STATUS(within(0, kMaxModules - 1));
      if (value != std::floor(value)) return Error(fmt::format("{}: a whole number is needed", value));
      to.module = static_cast<int>(value);
      return {};
    case kU:
    case kV:
      (column == kU ? to.in_image.x : to.in_image.y) = value;
      return within(-kMostPlace_px, kMostPlace_px);
    case kS:
    case kY:
      (column == kS ? to.on_screen.x : to.on_screen.y) = value;
      return within(-kMaxScreenPlace_m, kMaxScreenPlace_m);
    case kSigma:
      to.sigma_px = value;
      return within(kLeastSigma_px, kMostSigma_px);
    case kColumns:
      break;
  }
  LFD_CHECK(false, "a column that no header can name");
}

Result<Observation> parse_line(std::string_view line, const std::vector<Column>& order) {
  Observation observation;
  std::optional<std::string_view> rest = line;
  for (const Column column : order) {
    const auto part = next_part(rest, ',');
    const char* const name = kNames[column];
    if (!part) return Error(fmt::format("{}: is missing: the line has fewer fields than the header", name));
    const auto value = parse_number(trimmed(*part));
    if (!value) return value.error().within(name);
    if (auto status = put(observation, column, *value); !status) return status.error().within(name);
  }
  if (rest) return Error(fmt::format("more fields than the header's {}: {}", order.size(), quoted(*rest)));
  return observation;
}

}  // namespace

std::string Observations::place_of(const Observation& observation) const {
  return fmt::format("{}:{}", source, observation.line);
}

Result<Observations> parse_observations(std::string_view text, std::string_view source) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // spreadsheets write it
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Observations observations{std::string(source), false, {}};
  std::optional<std::vector<Column>> order;
  std::optional<std::string_view> rest = text;
  std::size_t number = 0;
  while (const auto line = next_part(rest, '\n')) {
    ++number;
    if (trimmed(*line).empty()) continue;
    const auto here = [&] { return fmt::format("{}:{}", source, number); };
    if (!order) {
      auto header = parse_header(*line);
      if (!header) return header.error().within(here());
      order = *std::move(header);
      observations.has_sigma = std::find(order->begin(), order->end(), kSigma) != order->end();
      continue;
    }
    if (observations.points.size() == kMaxObservations) {
      return Error(fmt::format("more than {} observations", kMaxObservations)).within(here());
    }
    auto observation = parse_line(*line, *order);
    if (!observation) return observation.error().within(here());
    observation->line = number;
    observations.points.push_back(*observation);
  }
  if (!order) return Error("is empty; a header module,u,v,s,y[,sigma] is needed").within(source);
  return observations;
}

Result<Observations> load_observations(const std::string& path) {
  LFD_TRY(const std::string text, read_file(path, kObservationFileLimit_bytes));
  return parse_observations(text, path);
}

std::string print_observations(const Observations& observations) {
  std::string text = observations.has_sigma ? "module,u,v,s,y,sigma\n" : "module,u,v,s,y\n";
  for (const Observation& o : observations.points) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{}", o.module, o.in_image.x, o.in_image.y, o.on_screen.x,
                   o.on_screen.y);
    if (observations.has_sigma) fmt::format_to(std::back_inserter(text), ",{}", o.sigma_px);
    text += '\n';
  }
  return text;
}

}  // namespace lfd
