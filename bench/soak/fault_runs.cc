// What is done to which process.
#include "bench/soak/fault_runs.h"

#include <signal.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/fault.h"
#include "base/log.h"

namespace lfd::bench {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 30s;  // for what a process is to do by itself
// Frames go on so long without a display: it is out once it is silent for six heartbeats, the first of which may have
// been due just when it was taken away.
constexpr auto kDisplayMissed = 5 * std::chrono::milliseconds(kHeartbeat_ms);

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

class Run {
 public:
  Run(SoakCluster& cluster, FaultChoice& choice) : cluster_(cluster), choice_(choice) {}

  Status start(const char* name) { return cluster_.start_daemon(name); }

  Status kill_for_a_while(std::initializer_list<const char*> names) {
    for (const char* const name : names) cluster_.daemons().kill(name);
    LFD_TRY_STATUS(cluster_.look_for(seconds(choice_.between(0, 1.0))));
    for (const char* const name : names) LFD_TRY_STATUS(start(name));
    return {};
  }

  Status kill_at_instant() {
    constexpr std::array kInstants{fault::kBegin, fault::kDrawing, fault::kDrawn, fault::kReady, fault::kSending};
    const std::string_view instant = kInstants[choice_.random()() % kInstants.size()];
    LFD_TRY(Process* const node, start_with(fmt::format("kill@{}:{}", instant, soon())));
    LFD_TRY(const bool ended, cluster_.look_until([node] { return node->poll().has_value(); }, kPatience));
    if (!ended) return Error(fmt::format("the node was not killed when it was {}", instant));
    return start("right");
  }

  Status lose_context() {
    LFD_TRY(Process* const node, start_with(fmt::format("lose-context@drawing:{}", soon())));
    LFD_TRY(const bool lost,
            cluster_.look_until([node] { return node->wait_for_line("the GL context was lost", 0ms).has_value(); },
                                kPatience));
    return lost ? Status() : Status(Error("the node did not lose its GL context"));
  }

  // Shorter or longer than the 0.6 s after which a peer is out.
  Status stop_for_a_while(const char* name) {
    cluster_.daemons().at(name).signal(SIGSTOP);
    Status looked = cluster_.look_for(seconds(choice_.between(0.1, 1.2)));
    cluster_.daemons().at(name).signal(SIGCONT);
    return looked;
  }

  Status slow_node() {
    LFD_TRY_STATUS(cluster_.daemons().start("right", {.environment = {{"LFD_SLOWDOWN", "500"}}}));
    LFD_TRY_STATUS(cluster_.look_for(1500ms));
    return start("right");
  }

 private:
  std::uint64_t soon() { return cluster_.last_frame() + 5 + choice_.random()() % 20; }
  Result<Process*> start_with(const std::string& faults) {
    return cluster_.daemons().start("right", {.environment = {{"LFD_FAULTS", faults}}});
  }

  SoakCluster& cluster_;
  FaultChoice& choice_;
};

Status do_to(SoakCluster& cluster, FaultChoice& choice, Fault fault) {
  Run run(cluster, choice);
  switch (fault) {
    case Fault::kKillNode:
      return run.kill_for_a_while({"right"});
    case Fault::kRestartNode:
      return run.start("right");
    case Fault::kKillNodeAtInstant:
      return run.kill_at_instant();
    case Fault::kStopNode:
      return run.stop_for_a_while("right");
    case Fault::kSlowNode:
      return run.slow_node();
    case Fault::kLoseContext:
      return run.lose_context();
    case Fault::kKillSpare:
      return run.kill_for_a_while({"reserve"});
    case Fault::kKillNodeAndSpare:
      return run.kill_for_a_while({"right", "reserve"});
    case Fault::kStopOtherNode:
      return run.stop_for_a_while("left");
    case Fault::kStopDisplay:
      return run.stop_for_a_while("display");
    case Fault::kStopController:
      return run.stop_for_a_while("controller");
    case Fault::kRemoveFolder: {
      std::error_code busy;
      std::filesystem::remove_all(cluster.daemons().shown(), busy);
      return {};
    }
    case Fault::kChangeScene:
      return cluster.change_scene();
    case Fault::kKillOtherNode:
      return run.kill_for_a_while({"left"});
    case Fault::kKillDisplay:
      return run.kill_for_a_while({"display"});
    case Fault::kKillController:
      return run.kill_for_a_while({"controller"});
  }
  return {};
}

}  // namespace

Result<Clock::duration> carry_out(Fault fault, SoakCluster& cluster, FaultChoice& choice) {
  const auto begun = Clock::now();
  LFD_TRY_STATUS(do_to(cluster, choice, fault));
  const Clock::duration took = Clock::now() - begun;
  if (fault == Fault::kStopController || fault == Fault::kKillController) return took;
  if (fault == Fault::kStopDisplay || fault == Fault::kKillDisplay) return std::max(took - kDisplayMissed, 0ns);
  return 0ns;
}

}  // namespace lfd::bench
