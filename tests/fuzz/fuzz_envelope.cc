// Fuzz target: one message of any bytes, taken by everybody; the first two bytes say how long its envelope is, the rest
// is its payload.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/peers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
  const std::size_t length = std::min<std::size_t>(data[0] + 256u * data[1], bytes.size());
  const auto envelope = lfd::fuzz::envelope_of(bytes.substr(0, length));
  if (!envelope) return 0;
  for (const char* const sender : {"L", "D", "stranger"}) {
    lfd::fuzz::Peers peers;
    peers.take(sender, *envelope, bytes.substr(length));
    peers.check();
  }
  return 0;
}
