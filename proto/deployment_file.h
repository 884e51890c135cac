// Deployment files (schema: proto/deployment.proto): one file says what a whole cluster is.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "calibration/display.h"
#include "proto/deployment.pb.h"
#include "proto/settings.h"

namespace lfd {

// A node keeps its modules in one array; more than these need another node.
inline constexpr int kMaxModulesPerNode = 256;

// The part of a display that one render node draws.
struct NodeShare {
  std::string name;          // unique; letters, digits, '.', '-', '_'
  std::vector<int> modules;  // ascending; no module has two nodes; empty where nodes outnumber them
  int gpu = -1;              // of `lfd-rendernode --list-gpus`; -1: the first that works
  bool spare = false;        // takes over the modules of a node that is out; has none of its own
};

struct Pacing {
  double frames_per_second = 0;           // 0: as fast as the nodes draw
  std::chrono::milliseconds deadline{0};  // begin to swap; 0: wait for every node
  std::chrono::milliseconds heartbeat{500};
  std::chrono::seconds hang{600};  // a node whose GPU brings nothing to an end for so long is of no use
};

// ZeroMQ endpoints, all given; a port written * is chosen freely.
struct Addresses {
  std::string control = "tcp://127.0.0.1:*";
  std::string state = "tcp://127.0.0.1:*";
  std::string bulk = "tcp://127.0.0.1:*";
  std::string images = "tcp://127.0.0.1:*";
};

// A deployment file, checked, with defaults filled in and paths resolved against the file's folder.
struct Deployment {
  proto::Deployment message;  // as it was written
  std::filesystem::path folder;
  std::filesystem::path display_file;
  DisplayCalibration display;
  std::optional<std::filesystem::path> scene_file;  // absent: message.scene().made()
  double animation_frames_per_second = 60;
  RenderSettings render;
  std::vector<NodeShare> nodes;
  Addresses addresses;
  Pacing pacing;
};

// What a command line says instead of the file; relative paths are those of the working directory.
struct DeploymentOverrides {
  std::optional<std::filesystem::path> display;  // the file's lists of modules are not used then: equal shares
  std::optional<std::filesystem::path> scene;
};

// Errors name file, line and field: `wall.textproto:14: node "b": modules: 17 is owned by node "a" already`.
Result<Deployment> load_deployment(const std::filesystem::path& path, const DeploymentOverrides& overrides = {});

// The same from the text of a file of that name, for a display that is there already: no file is read.
Result<Deployment> parse_deployment(std::string_view text, const std::string& name, const DisplayCalibration& display);

// Modules of the display that no node draws, ascending.
std::vector<int> unowned_modules(const Deployment& deployment);

// Shares of modules 0..module_count-1 among so many nodes: contiguous, ascending, sizes that differ by one at most.
std::vector<std::vector<int>> equal_shares(int module_count, int nodes);

}  // namespace lfd
