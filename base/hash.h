// Content hashes: 128-bit XXH3 of bytes, printed as 32 hexadecimal digits. Not cryptographic: it finds equal content,
// not forgers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lfd {

struct Hash128 {
  std::uint64_t high = 0, low = 0;

  bool operator==(const Hash128&) const = default;
};

// The hash itself, and as text.
Hash128 hash_128(std::string_view bytes);
std::string content_hash(std::span<const std::byte> bytes);
std::string content_hash(std::string_view bytes);

}  // namespace lfd
