// Versions that processes and reports name.
#pragma once

namespace lfd {

inline constexpr const char* kVersion = "0.1.0";

// Raised whenever a message changes its meaning; peers of another number are refused.
inline constexpr unsigned kProtocolVersion = 2;

}  // namespace lfd
