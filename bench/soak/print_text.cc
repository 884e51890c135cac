// The table of a soak, as text.
#include <algorithm>
#include <map>
#include <vector>

#include "base/log.h"
#include "bench/soak/soak_table.h"

namespace lfd::bench {
namespace {

// Last words of processes may have control characters.
std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

std::string text_of(const std::vector<SoakTable::Outcome>& outcomes) {
  struct Seconds {
    std::vector<double> recovery;
    double pause = 0;
  };
  std::map<Fault, Seconds> by_fault;
  for (const SoakTable::Outcome& outcome : outcomes) {
    Seconds& here = by_fault[outcome.fault];
    here.recovery.push_back(outcome.recovery_s);
    here.pause = std::max(here.pause, outcome.pause_s);
  }
  std::string text = fmt::format("{:<42} {:>6} {:>15} {:>15} {:>15} {:>8}\n", "fault", "times", "median s after",
                                 "worst s after", "longest pause", "allowed");
  for (auto& [fault, seconds] : by_fault) {
    std::ranges::sort(seconds.recovery);
    text += fmt::format("{:<42} {:>6} {:>15.2f} {:>15.2f} {:>15.2f} {:>8.2f}\n", name_of(fault),
                        seconds.recovery.size(), seconds.recovery[seconds.recovery.size() / 2], seconds.recovery.back(),
                        seconds.pause, most_pause_s(fault));
  }
  return text +
         fmt::format(
             "after: until all draw again, from the end of the fault; at most {:.0f} s. pause: s between two swaps, "
             "less those that\nthe controller or the display was stopped or dead: without them nothing is shown.\n",
             kMostRecovery_s);
}

}  // namespace

std::string SoakTable::verdict() const {
  if (broken.empty())
    return fmt::format("passed: {} faults, {} frames looked at, none mixed", outcomes.size(), shown_frames);
  return fmt::format("failed: {}", one_line(fmt::format("{}", fmt::join(broken, "; "))));
}

std::string text_of(const SoakTable& table) {
  std::string text =
      fmt::format("{} faults in {:.0f} s, seed {}\n\n", table.outcomes.size(), table.took_s, table.options.seed);
  text += text_of(table.outcomes);
  text += fmt::format(
      "\nframes: {} shown and looked at, {} of them with stale modules, {} mixed ({} modules judged); {} swapped "
      "late\n\n",
      table.shown_frames, table.stale_frames, table.mixed_frames, table.judged_modules, table.late_frames);
  text +=
      fmt::format("{:<42} {:>10} {:>10} {:>10} {:>18}\n", "process", "MiB then", "MiB now", "growth", "descriptors");
  for (const SoakTable::Growth& growth : table.growths) {
    text +=
        fmt::format("{:<42} {:>10.1f} {:>10.1f} {:>10.1f} {:>10} to {:>4}\n", growth.process, growth.mib_then,
                    growth.mib_now, growth.mib_now - growth.mib_then, growth.descriptors_then, growth.descriptors_now);
  }
  text += fmt::format(
      "then: after the first tenth of the faults; now: after the last; both of the first scene, shown after the other. "
      "Faults kill\nthese processes in the first twentieth alone. At most {:.0f} MiB more, and as many descriptors.\n",
      kMostGrowth_mib);
  return text + "\n" + table.verdict() + "\n";
}

}  // namespace lfd::bench
