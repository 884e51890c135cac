// Methods by their names.
#include "proto/occlusion/method.h"

#include <algorithm>

namespace lfd::occlusion {

const Method* find_method(std::string_view name) {
  const auto found = std::ranges::find(methods(), name, &Method::name);
  return found == methods().end() ? nullptr : *found;
}

std::vector<double> fallbacks(const Method& method) {
  std::vector<double> values;
  for (const Parameter& parameter : method.parameters) values.push_back(parameter.fallback);
  return values;
}

}  // namespace lfd::occlusion
