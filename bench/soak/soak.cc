// Fault after fault, and the bounds.
#include "bench/soak/soak.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/log.h"
#include "bench/soak/fault_runs.h"
#include "bench/common/process_facts.h"
#include "bench/soak/soak_cluster.h"

namespace lfd::bench {
namespace {

using namespace std::chrono_literals;

constexpr auto kStartPatience = 60s;                   // of a software rasteriser on a loaded machine
constexpr auto kQuiet = 200ms;                         // frames between two faults
constexpr double kBaselineAt = 0.1, kHarshFrom = 0.7;  // shares of the whole
// That live through all gentle faults.
constexpr std::array kWatched{"controller", "display", "left"};

class Soak {
 public:
  Soak(const SoakOptions& options, SoakCluster& cluster, const std::function<void(const std::string&)>& progress)
      : options_(options), cluster_(cluster), progress_(progress), choice_(options.seed) {}

  Result<SoakTable> run() {
    LFD_TRY(const bool whole, cluster_.look_until([this] { return cluster_.is_whole(); }, kStartPatience));
    if (!whole) return Error("the cluster did not draw before the first fault");
    begun_ = Clock::now();
    while (share_done() < 1) {
      const bool harsh = share_done() >= kHarshFrom;
      if (harsh && !measured_) LFD_TRY_STATUS(measure_growth());
      LFD_TRY(const bool goes_on, one_fault(choice_.next(!harsh)));
      if (!goes_on) break;
      if (!baseline_ && share_done() >= kBaselineAt) LFD_TRY_STATUS(take_baseline());
    }
    if (!measured_ && baseline_) LFD_TRY_STATUS(measure_growth());
    SoakTable table = std::move(cluster_.counts);
    table.options = options_;
    table.took_s = milliseconds(Clock::now() - begun_) / 1000;
    table.recoveries = std::move(recoveries_);
    table.growths = std::move(growths_);
    table.broken = std::move(broken_);
    judge(table);
    return table;
  }

 private:
  double share_done() const {
    if (options_.faults) return static_cast<double>(recoveries_.size()) / *options_.faults;
    return milliseconds(Clock::now() - begun_) / 60'000 / options_.minutes;
  }

  // False where the cluster has not recovered: there is no use in more faults.
  Result<bool> one_fault(Fault fault) {
    const bool pauses = fault == Fault::kStopDisplay || fault == Fault::kStopController ||
                        fault == Fault::kKillDisplay || fault == Fault::kKillController;
    cluster_.expect_frames(!pauses);
    LFD_TRY_STATUS(carry_out(fault, cluster_, choice_));
    const auto over = Clock::now();
    const std::uint64_t shown = cluster_.counts.shown_frames;
    const auto recovered = [&] { return cluster_.counts.shown_frames > shown && cluster_.is_whole(); };
    LFD_TRY(const bool whole, cluster_.look_until(recovered, 2 * seconds(kMostRecovery_s)));
    const double seconds_taken = milliseconds(Clock::now() - over) / 1000;
    recoveries_.push_back({fault, seconds_taken});
    progress_(
        fmt::format("fault {}: {}; whole again after {:.1f} s", recoveries_.size(), name_of(fault), seconds_taken));
    if (!whole) broken_.push_back(fmt::format("{}: the cluster is not whole again", name_of(fault)));
    cluster_.expect_frames(true);
    LFD_TRY_STATUS(cluster_.look_for(kQuiet));
    return whole;
  }

  static Clock::duration seconds(double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
  }

  // After a while without a fault, so that nothing is under way that comes and goes.
  Result<std::map<std::string, ProcessFacts>> facts() {
    LFD_TRY_STATUS(cluster_.look_for(1s));
    std::map<std::string, ProcessFacts> all;
    for (const char* const name : kWatched) {
      const auto here = facts_of(cluster_.daemons().at(name).id());
      if (!here)
        return Error(fmt::format("{} has ended: {}", name, fmt::join(cluster_.daemons().at(name).lines(), "; ")));
      all[name] = *here;
    }
    return all;
  }

  Status take_baseline() {
    LFD_TRY(baseline_, facts());
    return {};
  }

  Status measure_growth() {
    measured_ = true;
    if (!baseline_) return {};
    LFD_TRY(const auto now, facts());
    for (const char* const name : kWatched) {
      const ProcessFacts &before = baseline_->at(name), &after = now.at(name);
      growths_.push_back({name, before.resident_mib, after.resident_mib, before.descriptors, after.descriptors});
    }
    return {};
  }

  static void judge(SoakTable& table) {
    if (table.mixed_frames > 0) table.broken.push_back(fmt::format("{} frames are mixed", table.mixed_frames));
    if (table.judged_modules == 0) table.broken.push_back("no frame could be looked at");
    for (const SoakTable::Recovery& recovery : table.recoveries) {
      if (recovery.seconds > kMostRecovery_s)
        table.broken.push_back(
            fmt::format("{}: whole again after {:.1f} s only", name_of(recovery.fault), recovery.seconds));
    }
    for (const SoakTable::Growth& growth : table.growths) {
      if (growth.mib_now - growth.mib_then > kMostGrowth_mib)
        table.broken.push_back(
            fmt::format("{} has grown by {:.1f} MiB", growth.process, growth.mib_now - growth.mib_then));
      if (growth.descriptors_now != growth.descriptors_then) {
        table.broken.push_back(fmt::format("{} has {} descriptors open, {} before", growth.process,
                                           growth.descriptors_now, growth.descriptors_then));
      }
    }
  }

  const SoakOptions& options_;
  SoakCluster& cluster_;
  const std::function<void(const std::string&)>& progress_;
  FaultChoice choice_;
  Clock::time_point begun_;
  std::vector<SoakTable::Recovery> recoveries_;
  std::vector<SoakTable::Growth> growths_;
  std::vector<std::string> broken_;
  std::optional<std::map<std::string, ProcessFacts>> baseline_;
  bool measured_ = false;
};

}  // namespace

Result<SoakTable> soak(const SoakOptions& options, StopSignals& signals,
                       const std::function<void(const std::string& line)>& progress) {
  LFD_TRY(const auto cluster, SoakCluster::start(signals));
  return Soak(options, *cluster, progress).run();
}

}  // namespace lfd::bench
