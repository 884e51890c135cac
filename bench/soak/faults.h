// The faults of a soak, and which comes next.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace lfd::bench {

enum class Fault {
  // Everybody but the victim, a render node, lives through these. "left" loses its GL context now and then meanwhile.
  kKillNode,           // and start it again after a while
  kRestartNode,        // kill it and start it at once
  kKillNodeAtInstant,  // at the beginning, drawing, drawn, ready or sending of a frame
  kStopNode,           // SIGSTOP, shorter or longer than the limit
  kSlowNode,           // slower than the deadline, for a while
  kLoseContext,        // of GL
  kStopOtherNode,
  kStopDisplay,
  kStopController,
  kRemoveFolder,  // that the display writes to
  kChangeScene,   // no fault, but nothing may come of it
  // One of the others dies.
  kKillSpare,
  kKillNodeAndSpare,
  kKillOtherNode,
  kKillDisplay,
  kKillController,
};

const char* name_of(Fault fault);

// Faults in an order that the seed alone decides: each kind that may come once, in a random order, then each once
// again, and so on.
class FaultChoice {
 public:
  explicit FaultChoice(std::uint64_t seed) : random_(seed) {}

  // `gentle`: such as the controller, the display, the other node and the spare live through; else such as kill one of
  // them.
  Fault next(bool gentle);

  // Uniform between both.
  double between(double low, double high);
  std::mt19937_64& random() { return random_; }

 private:
  std::mt19937_64 random_;
  std::vector<Fault> left_;
  bool gentle_ = true;
};

}  // namespace lfd::bench
