// The time of day, for people: what happens is ordered by Clock alone.
#pragma once

#include <string>

namespace lfd {

// Now, in the local time zone: "2026-05-01 14:03:12".
std::string time_of_day();

}  // namespace lfd
