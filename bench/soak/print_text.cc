// The table of a soak, as text.
#include <algorithm>
#include <map>

#include "base/log.h"
#include "bench/soak/soak.h"

namespace lfd::bench {

std::string SoakTable::verdict() const {
  if (broken.empty())
    return fmt::format("passed: {} faults, {} frames looked at, none mixed", recoveries.size(), shown_frames);
  return fmt::format("failed: {}", fmt::join(broken, "; "));
}

std::string text_of(const SoakTable& table) {
  std::string text =
      fmt::format("{} faults in {:.0f} s, seed {}\n\n", table.recoveries.size(), table.took_s, table.options.seed);
  std::map<Fault, std::vector<double>> by_fault;
  for (const SoakTable::Recovery& recovery : table.recoveries) by_fault[recovery.fault].push_back(recovery.seconds);
  text += fmt::format("{:<42} {:>6} {:>15} {:>15}\n", "fault", "times", "median s after", "worst s after");
  for (auto& [fault, seconds] : by_fault) {
    std::ranges::sort(seconds);
    text += fmt::format("{:<42} {:>6} {:>15.2f} {:>15.2f}\n", name_of(fault), seconds.size(),
                        seconds[seconds.size() / 2], seconds.back());
  }
  text += fmt::format(
      "\nframes: {} shown and looked at, {} of them with stale modules, {} mixed ({} modules judged); {} swapped late; "
      "longest "
      "pause {:.2f} s\n\n",
      table.shown_frames, table.stale_frames, table.mixed_frames, table.judged_modules, table.late_frames,
      table.longest_pause_s);
  text +=
      fmt::format("{:<42} {:>10} {:>10} {:>10} {:>18}\n", "process", "MiB then", "MiB now", "growth", "descriptors");
  for (const SoakTable::Growth& growth : table.growths) {
    text +=
        fmt::format("{:<42} {:>10.1f} {:>10.1f} {:>10.1f} {:>10} to {:>4}\n", growth.process, growth.mib_then,
                    growth.mib_now, growth.mib_now - growth.mib_then, growth.descriptors_then, growth.descriptors_now);
  }
  return text + "\n" + table.verdict() + "\n";
}

}  // namespace lfd::bench
