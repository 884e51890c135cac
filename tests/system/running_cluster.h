// A cluster that runs: how it is started, and how its status and its lines are waited for.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/ctl_requests.h"
#include "proto/pictures/picture.h"
#include "proto/wire.pb.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {

// Of a test with a software rasteriser, which starts slowly on a busy machine; nothing is measured by it.
inline constexpr std::chrono::seconds kClusterPatience{60};

struct Running {
  std::unique_ptr<Process> lfd;
  std::string endpoint;  // of the controller
};

// `lfd run`, as soon as it says that it runs.
Running run_cluster(const std::filesystem::path& deployment, std::vector<std::string> more = {});

// The status of a controller; an endpoint alone stands for one without keys.
Result<proto::Status> status_at(const ControllerAt& controller);

// Asks for the status until `wanted` is true of it. A failure says what the last one was.
testing::AssertionResult becomes(const ControllerAt& controller,
                                 const std::function<bool(const proto::Status& status)>& wanted);

// What `lfd ctl` prints; a failure of the test where it fails.
std::vector<std::string> ctl(const Running& running, std::vector<std::string> arguments);

// The status, once all nodes hold the controller's state.
proto::Status settled_status(const Running& running);

// The picture of a module that its node writes for a frame into this folder, as soon as it is there.
std::optional<Picture8> written_picture(const std::filesystem::path& folder, std::uint64_t frame, std::uint32_t module);

// Waits until all nodes take part and `frames` more frames have been swapped.
testing::AssertionResult draws(const ControllerAt& controller, std::uint64_t frames);

// The peer of this name; an empty message where there is none.
proto::PeerStatus peer_in(const proto::Status& status, const std::string& name);

// Whether every node is ready with the controller's own state.
bool all_nodes_follow(const proto::Status& status);

// How many of the lines that the process has said so far contain `text`.
std::ptrdiff_t lines_with(const Process& process, const std::string& text);

// Waits until so many have; whether they have. Unlike Process::wait_for_line it passes over nothing.
bool says(const Process& process, const std::string& text, std::ptrdiff_t times = 1);

}  // namespace lfd::harness
