// Names and choice.
#include "bench/soak/faults.h"

#include <algorithm>

namespace lfd::bench {
namespace {

constexpr int kKinds = static_cast<int>(Fault::kKillController) + 1;
constexpr Fault kLastGentle = Fault::kChangeScene;

}  // namespace

const char* name_of(Fault fault) {
  switch (fault) {
    case Fault::kKillNode:
      return "node killed";
    case Fault::kRestartNode:
      return "node killed, restarted at once";
    case Fault::kKillNodeAtInstant:
      return "node killed at an instant of a frame";
    case Fault::kStopNode:
      return "node stopped";
    case Fault::kSlowNode:
      return "node slow";
    case Fault::kLoseContext:
      return "GL context lost";
    case Fault::kKillSpare:
      return "spare killed";
    case Fault::kKillNodeAndSpare:
      return "node and spare killed";
    case Fault::kStopOtherNode:
      return "other node stopped";
    case Fault::kStopDisplay:
      return "display stopped";
    case Fault::kStopController:
      return "controller stopped";
    case Fault::kRemoveFolder:
      return "folder of pictures removed";
    case Fault::kChangeScene:
      return "scene changed";
    case Fault::kKillOtherNode:
      return "other node killed";
    case Fault::kKillDisplay:
      return "display killed";
    case Fault::kKillController:
      return "controller killed";
  }
  return "unknown";
}

Fault FaultChoice::next(bool gentle) {
  const auto fits = [gentle](Fault fault) { return gentle == (fault <= kLastGentle); };
  if (left_.empty() || gentle != gentle_) {
    gentle_ = gentle;
    left_.clear();
    for (int kind = 0; kind < kKinds; ++kind) left_.push_back(static_cast<Fault>(kind));
    std::erase_if(left_, [&](Fault fault) { return !fits(fault); });
    for (std::size_t i = left_.size(); i > 1; --i) std::swap(left_[i - 1], left_[random_() % i]);
  }
  const Fault fault = left_.back();
  left_.pop_back();
  return fault;
}

double FaultChoice::between(double low, double high) {
  return low + (high - low) * static_cast<double>(random_() >> 11) / static_cast<double>(std::uint64_t{1} << 53);
}

}  // namespace lfd::bench
