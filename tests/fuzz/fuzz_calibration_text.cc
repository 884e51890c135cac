// Fuzz target: calibrations in text format are refused, or written and read again they are equal.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/check.h"
#include "proto/calibration_file.h"
#include "proto/text_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  lfd::proto::DisplayCalibration message;
  const auto places = lfd::parse_text(text, "f", message);
  if (!places) return 0;
  const auto display = lfd::read_calibration(message);
  if (!display) {
    LFD_CHECK(!places->locate(display.error()).message().empty(), "every refusal has a reason");
    return 0;
  }
  lfd::proto::DisplayCalibration again;
  LFD_CHECK(lfd::parse_text(lfd::print_text(lfd::write_calibration(*display)), "g", again), "what is written is read");
  const auto copy = lfd::read_calibration(again);
  LFD_CHECK(copy && *copy == *display, "the same display comes back");
  return 0;
}
