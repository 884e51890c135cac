// How a process that takes and gives back megabytes all the time keeps its memory.
#pragma once

namespace lfd {

// Freed blocks stay with the process, up to a gigabyte, and serve every thread: otherwise each one is given back to the
// system and comes anew, page by page, filled with zeroes, which costs a third of what the loopback interface can
// carry. Call it before any thread starts.
void keep_large_blocks();

// What is free goes back to the system now: after a thread that used much has ended, since nobody may use as much again.
void give_memory_back();

}  // namespace lfd
