// Content hashes through xxHash (this is its one door).
#include "base/hash.h"

#include <xxhash.h>

#include "base/log.h"

namespace lfd {

std::string content_hash(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string content_hash(std::string_view bytes) { return content_hash(std::as_bytes(std::span(bytes))); }

}  // namespace lfd
