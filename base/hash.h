// Content hashes: 128-bit XXH3 of bytes, printed as 32 hexadecimal digits. Not cryptographic: it finds equal content,
// not forgers.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace lfd {

std::string content_hash(std::span<const std::byte> bytes);
std::string content_hash(std::string_view bytes);

}  // namespace lfd
