// Names and values.
#include "cli/ao_parameter.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "base/log.h"
#include "proto/occlusion/method.h"
#include "proto/settings.h"

namespace lfd {
namespace {

// What each method that has it takes, a range once for all that agree.
std::string ranges_of(std::string_view name) {
  std::vector<std::pair<std::string, std::vector<std::string_view>>> ranges;
  for (const occlusion::Method* method : occlusion::methods()) {
    for (const occlusion::Parameter& one : method->parameters) {
      if (one.name != name) continue;
      const std::string range = fmt::format("{:g} to {:g}", one.least, one.most);
      if (ranges.empty() || ranges.back().first != range) ranges.push_back({range, {}});
      ranges.back().second.push_back(method->name);
    }
  }
  std::vector<std::string> texts;
  texts.reserve(ranges.size());
  for (const auto& [range, methods] : ranges)
    texts.push_back(fmt::format("{} for {}", range, fmt::join(methods, ", ")));
  return fmt::format("{}", fmt::join(texts, "; "));
}

bool some_method_takes(std::string_view name, double value) {
  return std::ranges::any_of(occlusion::methods(), [&](const occlusion::Method* method) {
    const auto known = std::ranges::find(method->parameters, name, &occlusion::Parameter::name);
    return known != method->parameters.end() && value >= known->least && value <= known->most;
  });
}

}  // namespace

Result<std::pair<std::string, double>> parse_ao_parameter(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return Error(fmt::format("\"{}\"; NAME=VALUE is expected", text));
  const std::string name = text.substr(0, equals);
  const char* const begin = text.data() + equals + 1;
  const char* const end = text.data() + text.size();
  double value = 0;
  const auto [stop, failure] = std::from_chars(begin, end, value);
  const bool is_number = failure == std::errc() && stop == end && std::isfinite(value);
  if (is_number && some_method_takes(name, value)) return std::pair(name, value);
  const std::string ranges = ranges_of(name);
  if (ranges.empty()) return Error(fmt::format("{}: no method has a parameter {}", text, name));
  return Error(fmt::format("{}: a number is needed, {}", text, ranges));
}

Status check_ao_parameters(const std::string& method, const std::vector<std::pair<std::string, double>>& parameters) {
  if (method.empty()) return {};
  proto::RenderSettings settings;
  settings.mutable_ao()->set_method(method);
  for (const auto& [name, value] : parameters) (*settings.mutable_ao()->mutable_parameter())[name] = value;
  const auto read = read_settings(settings);
  return read ? Status() : Status(read.error());
}

}  // namespace lfd
