// Nearness of texts by edit distance.
#include "base/suggest.h"

#include <algorithm>
#include <vector>

#include "base/log.h"

namespace lfd {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t columns = b.size() + 1;
  std::vector<std::size_t> table((a.size() + 1) * columns);
  const auto at = [&table, columns](std::size_t i, std::size_t j) -> std::size_t& { return table[i * columns + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        at(i, j) = i + j;
        continue;
      }
      const std::size_t replaced = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return at(a.size(), b.size());
}

std::optional<std::string> closest(std::string_view written, std::span<const std::string> known) {
  std::optional<std::string> best;
  std::size_t best_distance = 0;
  for (const std::string& candidate : known) {
    const bool is_beginning = written.size() >= 2 && candidate.starts_with(written);
    const std::size_t distance = is_beginning ? 0 : edit_distance(written, candidate);
    const std::size_t near = std::max<std::size_t>(1, std::max(written.size(), candidate.size()) / 3);
    if (distance <= near && (!best || distance < best_distance)) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string unknown_text(std::string_view what, std::string_view written, std::span<const std::string> known) {
  const auto meant = closest(written, known);
  return fmt::format(
      "unknown {} {}; {}", what, written,
      meant ? fmt::format("did you mean {}?", *meant) : fmt::format("{} are possible", fmt::join(known, ", ")));
}

}  // namespace lfd
