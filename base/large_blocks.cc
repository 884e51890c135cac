// Settings of glibc's allocator.
#include "base/large_blocks.h"

#include <malloc.h>

namespace lfd {

void keep_large_blocks() {
  constexpr int kLargest_bytes = 32 << 20;  // that the allocator lets this be said of
  constexpr int kKept_bytes = 1 << 30;
  ::mallopt(M_ARENA_MAX, 1);
  ::mallopt(M_MMAP_THRESHOLD, kLargest_bytes);
  ::mallopt(M_TRIM_THRESHOLD, kKept_bytes);
}

void give_memory_back() { ::malloc_trim(0); }

}  // namespace lfd
