// Whether GL had the memory for what was made last.
#pragma once

#include <string_view>

#include "base/result.h"

namespace lfd::gl {

// An error where GL has run out of memory since the last call ("the GPU has no memory for WHAT"). Forgets every other
// GL error too: the debug output has told of those.
Status memory_status(std::string_view what);

}  // namespace lfd::gl
