// The virtual display as a process: joins the controller, takes images from nodes, shows whole frames.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "base/metric_server.h"
#include "base/result.h"
#include "calibration/spaces/pixel.h"
#include "proto/wire/socket.h"

namespace lfd::display {

struct DaemonOptions {
  std::string controller;                    // control endpoint
  std::string images = "tcp://127.0.0.1:*";  // where nodes send to; bound here
  std::string name = "display";
  std::string calibration_hash;              // of a calibration that the controller's must equal; empty: any
  std::optional<std::filesystem::path> out;  // where frames are written; absent: nowhere
  std::string metrics;                       // where Prometheus is answered; empty: nowhere
  std::string key_file;                      // empty: without keys
  std::set<std::string> nodes;               // that may send images; empty: any
  std::optional<ImageSize> image;            // of a module, where it is known beforehand: nothing larger is taken in
};

// Of the socket that takes images of modules of this size, where it is known: nothing larger is taken in, and of what
// nobody has looked at no more than 256 MiB, or 16 images where that is more, of each connection. What does not fit
// waits at its sender, credit or not.
wire::Limits image_limits(const std::optional<ImageSize>& image);

// Runs until SIGTERM, SIGINT or the controller's Quit (success), a refusal by the controller, or an endpoint that
// cannot be used. A controller that is away is waited for. Call it before any thread starts: it blocks those two
// signals.
Status run_daemon(const DaemonOptions& options);

}  // namespace lfd::display
