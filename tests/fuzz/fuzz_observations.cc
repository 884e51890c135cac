// Fuzz target: observations are refused, or written and read again they are equal.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/check.h"
#include "calibration/fit/observations.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto read = lfd::parse_observations({reinterpret_cast<const char*>(data), size}, "f");
  if (!read) {
    LFD_CHECK(!read.error().message().empty(), "every refusal has a reason");
    return 0;
  }
  auto copy = lfd::parse_observations(lfd::print_observations(*read), "f");
  LFD_CHECK(copy && copy->points.size() == read->points.size(), "what is written is read");
  // Lines may have been left empty.
  for (std::size_t i = 0; i < read->points.size(); ++i) copy->points[i].line = read->points[i].line;
  LFD_CHECK(*copy == *read, "the same observations come back");
  return 0;
}
