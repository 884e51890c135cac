// Files of /proc.
#include "bench/soak/process_facts.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

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

std::optional<double> processor_time_s(int process) {
  std::ifstream stat(fmt::format("/proc/{}/stat", process));
  const std::string text((std::istreambuf_iterator<char>(stat)), {});
  const auto name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(name_end + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  double user = 0, system = 0;
  if (!(fields >> user >> system)) return std::nullopt;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

}  // namespace lfd::bench
