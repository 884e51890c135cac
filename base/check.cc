// Prints the broken condition before the process ends.
#include "base/check.h"

#include <cstdio>
#include <cstdlib>

namespace lfd {

void check_failed(const char* file, int line, const char* condition, std::string_view why) {
  std::fprintf(stderr, "%s:%d: check failed: %s: %.*s\n", file, line, condition, static_cast<int>(why.size()),
               why.data());
  std::fflush(stderr);
  std::abort();
}

}  // namespace lfd
