// Each bound of a soak.
#include "base/log.h"
#include "bench/soak/soak_table.h"

namespace lfd::bench {
namespace {

void judge_outcome(const SoakTable::Outcome& outcome, std::vector<std::string>& broken) {
  const char* const name = name_of(outcome.fault);
  if (!(outcome.recovery_s <= kMostRecovery_s))
    broken.push_back(fmt::format("{}: whole again after {:.1f} s only", name, outcome.recovery_s));
  if (!(outcome.pause_s <= most_pause_s(outcome.fault)))
    broken.push_back(fmt::format("{}: no frame for {:.2f} s, {:.2f} s are allowed", name, outcome.pause_s,
                                 most_pause_s(outcome.fault)));
}

void judge_growth(const SoakTable::Growth& growth, std::vector<std::string>& broken) {
  const double mib = growth.mib_now - growth.mib_then;
  if (!(mib <= kMostGrowth_mib)) broken.push_back(fmt::format("{} has grown by {:.1f} MiB", growth.process, mib));
  if (growth.descriptors_now != growth.descriptors_then) {
    broken.push_back(fmt::format("{} has {} descriptors open, {} before", growth.process, growth.descriptors_now,
                                 growth.descriptors_then));
  }
}

}  // namespace

double most_pause_s(Fault fault) {
  switch (fault) {
    case Fault::kStopController:
    case Fault::kStopDisplay:
      return kMostPauseAfterStop_s;
    case Fault::kKillController:
    case Fault::kKillDisplay:
      return kMostPauseAfterStart_s;
    default:
      return kMostPause_s;
  }
}

void judge(SoakTable& table) {
  if (table.mixed_frames > 0) table.broken.push_back(fmt::format("{} frames are mixed", table.mixed_frames));
  if (table.judged_modules == 0) table.broken.push_back("no frame could be looked at");
  for (const SoakTable::Outcome& outcome : table.outcomes) judge_outcome(outcome, table.broken);
  if (table.growths.empty()) table.broken.push_back("memory and descriptors were not measured");
  for (const SoakTable::Growth& growth : table.growths) judge_growth(growth, table.broken);
}

}  // namespace lfd::bench
