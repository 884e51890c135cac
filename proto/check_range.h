// Refusing numbers of messages that are beyond what their fields may have.
#pragma once

#include "base/log.h"
#include "base/result.h"

namespace lfd {

// "`field`: 1000; 1 to 256 are possible". What is no number is beyond every range.
inline Status check_range(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return Error(fmt::format("{}: {}; {} to {} are possible", field, value, low, high));
}

}  // namespace lfd
