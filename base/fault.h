// Faults that a test plants in a process: at a named instant of a frame it kills itself, stops, or is told to fail.
//
// The environment variable LFD_FAULTS lists them: ACTION@INSTANT:FRAME[,...], as in "kill@drawn:20". Each happens once,
// at the first such instant of that frame or a later one; a picture drawn for nobody passes "drawing" as frame 0.
// Without the variable nothing happens.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace lfd::fault {

// The instants of a frame in a render node.
inline constexpr std::string_view kBegin = "begin", kDrawing = "drawing", kDrawn = "drawn", kReady = "ready",
                                  kSending = "sending";

struct Plan {
  std::string_view action;
  std::string_view instant;
  std::uint64_t frame = 0;
  bool done = false;
};

// Items that cannot be read are left out.
std::vector<Plan> parse(std::string_view text);

// Carries out "kill" (SIGKILL to itself) and "stop" (SIGSTOP) where they are planned for this instant.
void at(std::string_view instant, std::uint64_t frame);

// Whether another action, which the caller carries out, is planned for this instant; true once.
bool due(std::string_view action, std::string_view instant, std::uint64_t frame);

// How many times longer each frame of this process is to take: LFD_SLOWDOWN; 1 without it.
double slowdown();

}  // namespace lfd::fault
