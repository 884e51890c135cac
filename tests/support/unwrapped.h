// Results in tests that cannot be errors.
#pragma once

#include <utility>

#include "base/check.h"
#include "base/result.h"

namespace lfd::testing_support {

// The value, or the end of the process with the error's message.
template <class T>
T unwrapped(Result<T> result) {
  LFD_CHECK(result, result.error().message());
  return *std::move(result);
}

}  // namespace lfd::testing_support
