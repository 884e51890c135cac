// From the header that the build writes.
#include "bench/common/built_commit.h"

#include "base/version.h"
#include "bench/common/commit.h"

namespace lfd::bench {

std::string built_commit() { return LFD_COMMIT; }

std::string built_version() { return std::string(kVersion) + ", commit " + built_commit(); }

}  // namespace lfd::bench
