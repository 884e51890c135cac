// Virtual clusters of many nodes on one machine: how long frames take from begin to shown, and what they cost the
// controller.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/signals.h"
#include "calibration/spaces/pixel.h"

namespace lfd::bench {

struct ClusterBenchOptions {
  std::vector<int> nodes{1, 2, 4, 8, 16};
  std::vector<int> modules{64, 80, 128};
  std::vector<std::string> scenes{"plane"};  // made ones; the first is shown to every cluster, the others to one
  // Scenes of so many instances at rest and a few that move, shown to one cluster; their frames are fewer, and at
  // least 0.4 s apart.
  std::vector<int> resting{1, 10'000};
  int frames = 500;
  int crowd_frames = 200;
  ImageSize image{16, 12};  // of a module: what is measured is the cluster, not the drawing
};

struct ClusterRow {
  int nodes = 0, modules = 0;
  std::string scene;
  std::optional<int> resting = {};  // instances, of a scene of many
  double scene_bytes = 0;           // of the scene's meshes and pictures
  double frames_per_s = 0;
  double shown_median_ms = 0, shown_99_ms = 0;  // begin to shown
  double swap_median_ms = 0, swap_99_ms = 0;    // begin to swap
  double at_rest_us = 0;                        // the controller's processor time per second without frames
  // Per frame.
  double controller_us = 0;  // the controller's processor time beyond that at rest, its answers to the bench included
  double state_bytes = 0;    // published; every node and the display get them
  double report_bytes = 0;   // of all nodes together
  double image_bytes = 0;    // payloads of all nodes together; unchanged images are not sent
};

// cost = constant + per_node * nodes, by least squares.
struct Line {
  double constant = 0, per_node = 0;
};

struct ClusterTable {
  ClusterBenchOptions options;
  std::vector<ClusterRow> rows;      // of the first scene
  std::vector<ClusterRow> by_scene;  // of the other scenes, and of the first with the same cluster
  std::vector<ClusterRow> by_rest;   // of scenes of ever more instances at rest

  // The controller's processor time over the number of nodes.
  Line controller_line(int modules) const;
};

// What a frame costs the controller, in processor time and in bytes published, may grow by this factor from the fewest
// to the most instances at rest. It should not grow at all: the room is for processes that share the machine (clusters
// whose scenes are alike differ by a quarter, by more with few frames), and for pulses, of which more come in frames
// that take longer. Where an update is hashed with the whole scene, ten thousand instances cost ten times as much.
inline constexpr double kMostGrowth = 1.5;

// Which cost has grown by more, for people; empty: none.
std::string missed_bound(const ClusterTable& table);

// Each cluster runs in a temporary folder, with the programs beside this one. For every frame the scene turns (an
// update of the state; in scenes of many what moves makes another), and the next begins when the last is shown. The
// display writes nothing. Errors: a cluster that does not run; a signal.
Result<ClusterTable> cluster_bench(const ClusterBenchOptions& options, StopSignals& signals,
                                   const std::function<void(const ClusterRow&)>& progress);

std::string text_of(const ClusterTable& table);
std::string csv_of(const ClusterTable& table);
std::string svg_of(const ClusterTable& table);

}  // namespace lfd::bench
