// Files of /proc.
#include "bench/common/process_facts.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/log.h"

namespace lfd::bench {
namespace fs = std::filesystem;

std::optional<ProcessFacts> facts_of(int process) {
  const fs::path folder = fmt::format("/proc/{}", process);
  std::ifstream statm(folder / "statm");
  long pages = 0, resident_pages = 0;
  if (!(statm >> pages >> resident_pages) || pages == 0) return std::nullopt;
  ProcessFacts facts;
  facts.resident_mib = static_cast<double>(resident_pages) * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
  std::error_code gone;
  for (fs::directory_iterator entry(folder / "fd", gone), end; !gone && entry != end; entry.increment(gone))
    ++facts.descriptors;
  if (gone) return std::nullopt;
  return facts;
}

// The first number of a thread's schedstat are nanoseconds on a processor; stat counts hundredths of a second alone.
std::optional<double> processor_time_s(int process) {
  double nanoseconds = 0;
  std::error_code gone;
  for (fs::directory_iterator entry(fmt::format("/proc/{}/task", process), gone), end; !gone && entry != end;
       entry.increment(gone)) {
    double of_thread = 0;
    if (!(std::ifstream(entry->path() / "schedstat") >> of_thread)) return std::nullopt;
    nanoseconds += of_thread;
  }
  if (gone) return std::nullopt;
  return nanoseconds / 1e9;
}

}  // namespace lfd::bench
