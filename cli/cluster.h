// A whole display as child processes of this one: controller, render nodes and virtual display, on one machine.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/process.h"
#include "base/result.h"
#include "base/signals.h"
#include "proto/deployment_file.h"

namespace lfd {

// What is shown instead of a scene.
struct ReplayOptions {
  std::filesystem::path file;  // a recording; empty: none is shown
  double speed = 1;            // times the recorded pace; 0: as fast as the nodes draw
  std::string frames;          // "A-B"; empty: all
  bool any_display = false;
};

// What a user can say about a cluster on a command line, beside its deployment file.
struct ClusterOptions {
  std::filesystem::path deployment;
  std::string scene, display;        // files instead of the deployment's; may be empty
  std::vector<double> roi;           // cx,cy,cz,sx,sy,sz; may be empty
  std::string plan;                  // "everything", "needed" or empty
  std::vector<std::string> modules;  // numbers and ranges of those that are drawn at all; empty: all
  bool no_ao = false;
  bool accept_calibration = false;  // even where it misses the limits of `lfd-calibrate check`
  bool idle = false;                // no frame until frames are asked for
  std::filesystem::path images;     // where the display writes every frame; empty: nowhere
  ReplayOptions replay;
  std::string log_level = "info";
  bool quiet = false;  // the lines of the children are not printed, only kept
};

// The deployment with the files that the options put in its place.
Result<Deployment> load_deployment(const ClusterOptions& options);

// The modules that the options name; empty: all. Errors name what is no number, no module of the display, or of no
// node.
Result<std::set<int>> wanted_modules(const ClusterOptions& options, const Deployment& deployment);

// The line of a program that says why it failed; printed with its end, not before.
inline constexpr std::string_view kErrorMark = "error: ";

// What a process had to say about its failure: its last error.
std::string last_words(const Process& process);

class Cluster {
 public:
  // Starts every process; they find each other in their own time. Lines of the children are printed on standard error
  // with their names. Errors: the deployment file, a program that is missing, a port that is taken (named with its
  // owner), a signal before the controller is there.
  static Result<Cluster> start(const ClusterOptions& options, StopSignals& signals);

  const Deployment& deployment() const { return deployment_; }
  const std::string& endpoint() const { return endpoint_; }     // of the controller
  const std::string& key_file() const { return key_file_; }     // of who may change the show; empty: without keys
  const std::vector<int>& modules() const { return modules_; }  // that are drawn, ascending

  // Waits until a child ends, a signal comes or `at_most` has passed.
  void wait(const StopSignals& signals, Clock::duration at_most) const;

  // Whether any child has ended.
  bool has_ended();

  // Waits until all have ended by themselves, as after a client's quit; an error names who failed or did not end.
  Status finish(Clock::duration at_most);

  // Once a child has ended: success where a client's quit (or a signal to the controller) is the reason, which the
  // controller's own good end within `at_most` tells, in whatever order the others go; else the error says who ended.
  Status quit_or_failed(Clock::duration at_most);

  // Ends all: SIGTERM to everyone at once, SIGKILL to whoever still runs after `patience`.
  void stop(Clock::duration patience);

 private:
  Cluster() = default;
  Status add(const ClusterOptions& options, const std::string& name, std::vector<std::string> command);

  Deployment deployment_;
  std::string endpoint_, key_file_;
  std::vector<int> modules_;
  std::vector<std::unique_ptr<Process>> processes_;  // the controller first
};

// How long processes that were asked to end may take: all are gone within 2 s.
inline constexpr Clock::duration kStopPatience = std::chrono::milliseconds(1500);

}  // namespace lfd
