// Whether a frame has numbers that no picture may have.
#pragma once

#include <string>

#include "rendernode/renderer.h"

namespace lfd::bench {

// Empty, or the buffer of floats that has a number that is not finite.
std::string fault_of(const FrameResult& frame);

}  // namespace lfd::bench
