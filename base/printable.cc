// Control characters: C0, delete, and C1 as UTF-8 has them.
#include "base/printable.h"

namespace lfd {

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool is_c1 = c == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (is_c1) ++i;
    out += is_c1 || c < 0x20 || c == 0x7f ? '?' : text[i];
  }
  return out;
}

std::string printable_lines(std::string_view text) {
  std::string out;
  for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n')) {
    out += printable(text.substr(0, end)) + "\n  | ";
    text.remove_prefix(end + 1);
  }
  return out + printable(text);
}

}  // namespace lfd
