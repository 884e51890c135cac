// Foreign text made harmless.
#pragma once

#include <string>
#include <string_view>

namespace lfd {

// The text with a question mark in place of every control character: what peers say of themselves reaches a screen.
std::string printable(std::string_view text);

// The same, but its lines stay; all but the first begin with "  | ", so that none can be taken for a line of the log.
std::string printable_lines(std::string_view text);

}  // namespace lfd
