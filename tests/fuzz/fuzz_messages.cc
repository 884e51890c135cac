// Fuzz target: many messages one after the other, with time in between, from members and strangers.
//
// A step is a byte (who, how long after the one before, whether there is a payload), two bytes for the length of the
// envelope, the envelope, and a byte for the length of the payload before it.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/log.h"
#include "tests/fuzz/peers.h"

namespace {

constexpr const char* kSenders[] = {"L", "R", "D", "stranger"};
constexpr std::chrono::milliseconds kWaits[] = {std::chrono::milliseconds(0), std::chrono::milliseconds(1),
                                                std::chrono::milliseconds(60), std::chrono::milliseconds(4000)};
constexpr int kMostSteps = 200;

std::string_view take(std::string_view& bytes, std::size_t count) {
  const std::string_view front = bytes.substr(0, count);
  bytes.remove_prefix(front.size());
  return front;
}

std::size_t number(std::string_view bytes) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) value |= std::size_t{static_cast<unsigned char>(bytes[i])} << 8 * i;
  return value;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  [[maybe_unused]] static const bool kQuiet = (lfd::start_log("fuzz", "off"), true);
  std::string_view bytes(reinterpret_cast<const char*>(data), size);
  lfd::fuzz::Peers peers;
  for (int step = 0; step < kMostSteps && !bytes.empty(); ++step) {
    const std::size_t control = number(take(bytes, 1));
    const std::string_view message = take(bytes, number(take(bytes, 2)));
    const std::string_view payload = (control & 16) != 0 ? take(bytes, number(take(bytes, 1))) : std::string_view();
    peers.wait(kWaits[control >> 2 & 3]);
    if (const auto envelope = lfd::fuzz::envelope_of(message)) peers.take(kSenders[control & 3], *envelope, payload);
    peers.check();
  }
  return 0;
}
