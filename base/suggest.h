// What a person may have meant who wrote something unknown.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lfd {

// The least number of letters to insert, delete, replace or swap with a neighbour that turns one text into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The known text that is nearest to `written`; absent where none is near (more than a third of the letters differ, and
// more than one), unless `written` is the beginning of one.
std::optional<std::string> closest(std::string_view written, std::span<const std::string> known);

// "unknown kind gird; did you mean grid?"; where nothing is near, "unknown kind stripes; checker, grid are possible".
std::string unknown_text(std::string_view what, std::string_view written, std::span<const std::string> known);

}  // namespace lfd
