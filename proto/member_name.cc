// One rule for all names.
#include "proto/member_name.h"

#include <algorithm>
#include <cctype>

namespace lfd {
namespace {

constexpr std::size_t kMostLetters = 64;

bool is_plain(unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_'); }

}  // namespace

Status check_member_name(std::string_view name) {
  const bool is_folder = name == "." || name == "..";
  if (!name.empty() && name.size() <= kMostLetters && !is_folder && std::ranges::all_of(name, is_plain)) return {};
  return Error("1 to 64 letters, digits, '.', '-' and '_' are possible, but neither \".\" nor \"..\"");
}

}  // namespace lfd
