// Content hashes through xxHash (this is its one door).
#include "base/hash.h"

#include <xxhash.h>

#include "base/log.h"

namespace lfd {

Hash128 hash_128(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.high64, hash.low64};
}

std::string content_hash(std::string_view bytes) {
  const Hash128 hash = hash_128(bytes);
  return fmt::format("{:016x}{:016x}", hash.high, hash.low);
}

std::string content_hash(std::span<const std::byte> bytes) {
  return content_hash(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace lfd
