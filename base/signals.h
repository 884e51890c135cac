// The signals that ask a process to end (SIGINT, SIGTERM, SIGHUP), as a descriptor to wait on instead of interruptions.
#pragma once

#include <optional>

namespace lfd {

class StopSignals {
 public:
  // Blocks them in this thread and in those it starts from now on: make one before anything starts a thread.
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // Readable while a signal waits to be taken.
  int descriptor() const { return descriptor_; }

  // The number of the signal that came, if one did.
  std::optional<int> take();

 private:
  int descriptor_;
};

}  // namespace lfd
