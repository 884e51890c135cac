// A folder for one test, with a small display in it, and the programs under test started from it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/process.h"
#include "base/temporary_folder.h"
#include "calibration/spaces/pixel.h"

namespace lfd::harness {

// A folder of its own that goes with the object. display.textproto in it is a display of four modules that stand 1 m
// behind a screen of 1.6 x 0.9 m, each with images of so many pixels.
class Workbench {
 public:
  explicit Workbench(ImageSize image = kSmallImage);
  static constexpr ImageSize kSmallImage{16, 8};

  // The calibration hash of that display.
  static std::string display_hash(ImageSize image = kSmallImage);

  const std::filesystem::path& folder() const { return folder_.path(); }

  // Writes a deployment of that display with a made scene and the nodes "left" and "right"; `more` is appended
  // (Protobuf text).
  std::filesystem::path deployment(const std::string& more, const std::string& file = "wall.textproto") const;

  // Writes any file; its path.
  std::filesystem::path file(const std::string& name, const std::string& content) const;

 private:
  TemporaryFolder folder_ = *TemporaryFolder::make("lfd-test");
};

// Starts a program of the build by name; fails the test (and aborts it) where that is not possible.
std::unique_ptr<Process> start_program(const std::string& program, std::vector<std::string> arguments);

// lfd-controller, and where it listens.
struct RunningController {
  std::unique_ptr<Process> process;
  std::string endpoint;
};
RunningController start_controller(const std::filesystem::path& deployment, std::vector<std::string> more = {});

// Ids of the living processes whose program's name starts with `name` and that descend from this process.
std::vector<int> descendants_named(const std::string& name);

// Whether a process runs: one that has ended, but that nobody has waited for yet, does not.
bool runs(int process);

// A port of the loopback interface that was free a moment ago.
int free_port();

}  // namespace lfd::harness
