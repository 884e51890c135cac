// Counting.
#include "bench/stability/tally.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/log.h"

namespace lfd::bench {
namespace {

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool has_word(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]))) return true;
  }
  return false;
}

// In `beginning` a '#' stands for any whole number.
bool begins_with(std::string_view text, const std::string& beginning) {
  for (const char c : beginning) {
    if (c != '#' && !text.starts_with(c)) return false;
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    if (c == '#' && digits == 0) return false;
    text.remove_prefix(c == '#' ? digits : 1);
  }
  return true;
}

}  // namespace

void Tally::refused(const std::string& value, const std::string& message) {
  ++refused_;
  const bool is_named = std::ranges::any_of(words_, [&](const std::string& word) { return has_word(message, word); });
  if (!is_named) fault(value, "error without the field's name: " + message);
  if (!begins_with(message, beginning_))
    fault(value, fmt::format("error that does not begin with \"{}\": {}", beginning_, message));
}

void Tally::accepted(const std::string& value, const std::string& harm) {
  ++accepted_;
  if (!harm.empty()) fault(value, harm);
}

Outcome Tally::outcome() const {
  if (!fault_.empty()) return {fault_, 0, false};
  return {fmt::format("{} refused, {} harmless", refused_, accepted_), 0, refused_ + accepted_ > 0};
}

void Tally::fault(const std::string& value, const std::string& what) {
  if (fault_.empty()) fault_ = fmt::format("{}: {}", value, what);
}

}  // namespace lfd::bench
