// Fault after fault, and the bounds.
#include "bench/soak/soak.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/log.h"
#include "bench/common/process_facts.h"
#include "bench/soak/fault_runs.h"
#include "bench/soak/soak_cluster.h"

namespace lfd::bench {
namespace {

using namespace std::chrono_literals;

constexpr auto kStartPatience = 60s;                       // of a software rasteriser on a loaded machine
constexpr auto kQuiet = 200ms;                             // frames between two faults
constexpr double kKillingUntil = 0.05, kBaselineAt = 0.1;  // shares of the whole
constexpr int kChanges = 4, kLooks = 10;                   // of scenes; after each
constexpr auto kBetweenLooks = 50ms;
// That live through all gentle faults, which are all that come after the baseline.
constexpr std::array kWatched{"controller", "display", "left", "reserve"};

class Soak {
 public:
  Soak(const SoakOptions& options, SoakCluster& cluster, const std::function<void(const std::string&)>& progress)
      : options_(options), cluster_(cluster), progress_(progress), choice_(options.seed) {}

  SoakTable run() {
    begun_ = Clock::now();
    const Status done = run_through();
    SoakTable table = std::move(cluster_.counts);
    if (!done) table.broken.push_back(done.error().message());
    table.options = options_;
    table.took_s = milliseconds(Clock::now() - begun_) / 1000;
    judge(table);
    return table;
  }

 private:
  // An error: why the soak ended before its time.
  Status run_through() {
    const auto draws = [this] { return cluster_.counts.shown_frames > 0 && cluster_.is_whole(); };
    LFD_TRY(const bool whole, cluster_.look_until(draws, kStartPatience));
    if (!whole) return not_whole("the cluster did not draw before the first fault");
    begun_ = Clock::now();
    while (share_done() < 1) {
      LFD_TRY_STATUS(one_fault(choice_.next(share_done() >= kKillingUntil)));
      if (baseline_.empty() && share_done() >= kBaselineAt) {
        LFD_TRY(baseline_, facts());
      }
    }
    return measure_growth();
  }

  double share_done() const {
    if (options_.faults) return static_cast<double>(cluster_.counts.outcomes.size()) / *options_.faults;
    return milliseconds(Clock::now() - begun_) / 60'000 / options_.minutes;
  }

  // Where the cluster does not recover there is no use in more faults.
  Status one_fault(Fault fault) {
    cluster_.forget_pauses();
    LFD_TRY(const Clock::duration away, carry_out(fault, cluster_, choice_));
    const auto over = Clock::now();
    const std::uint64_t shown = cluster_.counts.shown_frames;
    const auto recovered = [&] { return cluster_.counts.shown_frames > shown && cluster_.is_whole(); };
    LFD_TRY(const bool whole, cluster_.look_until(recovered, 2 * seconds(kMostRecovery_s)));
    const double recovery_s = milliseconds(Clock::now() - over) / 1000;
    if (whole) LFD_TRY_STATUS(cluster_.look_for(kQuiet));
    const double pause_s = std::max(milliseconds(cluster_.longest_pause() - away) / 1000, 0.0);
    cluster_.counts.outcomes.push_back({fault, recovery_s, pause_s});
    progress_(fmt::format("fault {}: {}; whole again after {:.1f} s, no frame for {:.2f} s",
                          cluster_.counts.outcomes.size(), name_of(fault), recovery_s, pause_s));
    return whole ? Status() : Status(not_whole(fmt::format("{}: the cluster is not whole again", name_of(fault))));
  }

  Error not_whole(std::string what) const {
    std::vector<std::string> all = cluster_.dead();
    all.insert(all.begin(), std::move(what));
    return Error(fmt::format("{}", fmt::join(all, "; ")));
  }

  static Clock::duration seconds(double s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
  }

  // The other scene, and then the first: a node holds what it draws, and the two do not take the same memory.
  Status show_both_scenes() {
    for (const bool other : {true, false}) {
      if (cluster_.shows_other_scene() == other) continue;
      LFD_TRY_STATUS(cluster_.change_scene());
      LFD_TRY(const bool whole,
              cluster_.look_until([this] { return cluster_.is_whole(); }, 2 * seconds(kMostRecovery_s)));
      if (!whole) return not_whole("a scene could not be changed");
    }
    return {};
  }

  // Faults as they come may have left the spare without a GL context all the time, or with one.
  Status let_spare_draw() {
    cluster_.daemons().kill("right");
    LFD_TRY(const bool drawn, cluster_.look_until([this] { return cluster_.spare_draws(); }, seconds(kMostRecovery_s)));
    if (!drawn) return not_whole("the spare does not draw");
    LFD_TRY_STATUS(cluster_.start_daemon("right"));
    LFD_TRY(const bool whole, cluster_.look_until([this] { return cluster_.is_whole(); }, seconds(kMostRecovery_s)));
    return whole ? Status() : Status(not_whole("the node does not draw again"));
  }

  // The least of several looks: the display opens files for every frame, and what a node holds of the same scene
  // differs by megabytes from one context to the next, and stays as it is until the next change.
  Result<std::map<std::string, ProcessFacts>> facts() {
    LFD_TRY_STATUS(let_spare_draw());
    std::map<std::string, ProcessFacts> least;
    for (int change = 0; change < kChanges; ++change) {
      LFD_TRY_STATUS(show_both_scenes());
      LFD_TRY_STATUS(look_at_facts(least));
    }
    return least;
  }

  // After a while without a fault, so that nothing is under way that comes and goes.
  Status look_at_facts(std::map<std::string, ProcessFacts>& all) {
    LFD_TRY_STATUS(cluster_.look_for(1s));
    for (int look = 0; look < kLooks; ++look) {
      LFD_TRY_STATUS(cluster_.look_for(kBetweenLooks));
      for (const char* const name : kWatched) {
        const auto here = facts_of(cluster_.daemons().at(name).id());
        if (!here) return not_whole(fmt::format("{} cannot be measured", name));
        ProcessFacts& least = all.try_emplace(name, *here).first->second;
        least.resident_mib = std::min(least.resident_mib, here->resident_mib);
        least.descriptors = std::min(least.descriptors, here->descriptors);
      }
    }
    return {};
  }

  Status measure_growth() {
    if (baseline_.empty()) return {};
    LFD_TRY(const auto now, facts());
    for (const auto& [name, before] : baseline_) {
      const ProcessFacts& after = now.at(name);
      cluster_.counts.growths.push_back(
          {name, before.resident_mib, after.resident_mib, before.descriptors, after.descriptors});
    }
    return {};
  }

  const SoakOptions& options_;
  SoakCluster& cluster_;
  const std::function<void(const std::string&)>& progress_;
  FaultChoice choice_;
  Clock::time_point begun_;
  std::map<std::string, ProcessFacts> baseline_;  // of those watched; empty: not taken yet
};

}  // namespace

Result<SoakTable> soak(const SoakOptions& options, StopSignals& signals,
                       const std::function<void(const std::string& line)>& progress) {
  LFD_TRY(const auto cluster, SoakCluster::start(signals));
  return Soak(options, *cluster, progress).run();
}

}  // namespace lfd::bench
