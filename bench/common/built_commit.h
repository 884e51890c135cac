// Which program a report is of.
#pragma once

#include <string>

namespace lfd::bench {

// Of the sources that were built, short, with "-dirty" where they had changes; "unknown" where the build knew none.
std::string built_commit();

// "0.1.0, commit 44e10f8"
std::string built_version();

}  // namespace lfd::bench
