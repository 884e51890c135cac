// Parts of the text that stand in files of their own.
#pragma once

#include <string>

#include "bench/ao/ao_bench.h"

namespace lfd::bench {

// What neighbours that share are worth: at equal time, in consistency, at silhouettes, at the display's edge, and as
// modules grow.
std::string sharing_text(const AoTable& table);

}  // namespace lfd::bench
