// The table of a frame bench for people, for spreadsheets and for programs.
#pragma once

#include <string>

#include "bench/frame/frame_bench.h"

namespace lfd::bench {

// Lines of at most 120 columns where names allow it.
std::string text_of(const FrameTable& table);

// Comma-separated: a line of titles, one line for each pass, and one for all passes, which carries the errors too.
std::string csv_of(const FrameTable& table);

std::string json_of(const FrameTable& table);

}  // namespace lfd::bench
