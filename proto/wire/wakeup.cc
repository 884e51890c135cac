// An eventfd, non-blocking.
#include "proto/wire/wakeup.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>

#include "base/check.h"

namespace lfd::wire {

Wakeup::Wakeup() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  LFD_CHECK(descriptor_ >= 0, "no file descriptor is left for an eventfd");
}

Wakeup::~Wakeup() { ::close(descriptor_); }

void Wakeup::ring() const {
  const std::uint64_t one = 1;
  // Fails only where the counter is at its end, and then it rings already.
  [[maybe_unused]] const auto written = ::write(descriptor_, &one, sizeof(one));
}

void Wakeup::silence() const {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto taken = ::read(descriptor_, &count, sizeof(count));
}

}  // namespace lfd::wire
