// An OpenGL 4.5 core context without a window system, through EGL (device or surfaceless platform).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace lfd::gl {

// One EGL device, as `lfd-rendernode --list-gpus` shows it.
struct Gpu {
  int index = 0;            // for Context::create; -1: the surfaceless platform of a driver that lists no devices
  std::string description;  // vendor, renderer and GL version, or why it cannot be used
  bool usable = false;
};

// All devices; where EGL lists none, the surfaceless platform.
std::vector<Gpu> list_gpus();

// Whether there is such a device, usable or not; below 0 none is named. Error: "gpu 3: there are 1 (see ...)".
Status check_gpu(int gpu);

// Current on the thread that made it until it is destroyed; it never changes threads. GL's debug output goes to the
// log.
class Context {
 public:
  // gpu: an index of list_gpus(); -1: the first that works, then the surfaceless platform.
  static Result<std::unique_ptr<Context>> create(int gpu);

  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();

  // Vendor, renderer and version, for reports.
  const std::string& description() const { return description_; }

  // Whether the renderer is one that is known to draw on the CPU.
  bool is_software() const;

  // Whether the driver has given the context up (a reset of the GPU): nothing it made can be used any more. Asks the
  // driver's robustness query, where it has one; that tells of a reset once, and a context that is lost stays lost.
  bool is_lost();
  // From now on it counts as lost (for tests).
  void lose() { lost_ = true; }

  // GL errors that the debug output has reported so far; tests want 0.
  static int error_count();

 private:
  Context() = default;
  Status open(void* display);

  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string description_;
  bool tells_resets_ = false;
  bool lost_ = false;
};

}  // namespace lfd::gl
