// Asking again and again, with a pause.
#include "tests/system/running_cluster.h"

#include <algorithm>
#include <optional>
#include <thread>

#include "base/log.h"
#include "proto/frame_files.h"
#include "proto/pictures/png.h"

namespace lfd::harness {
namespace {

constexpr auto kPause = std::chrono::milliseconds(50);

}  // namespace

Running run_cluster(const std::filesystem::path& deployment, std::vector<std::string> more) {
  more.insert(more.begin(), {"run", deployment.string()});
  Running running{start_program("lfd", std::move(more)), ""};
  const auto line = running.lfd->wait_for_line(fmt::format("running {}", deployment.string()), kClusterPatience);
  EXPECT_TRUE(line) << testing::PrintToString(running.lfd->lines());
  if (line) running.endpoint = line->substr(line->find("tcp://"));
  return running;
}

Result<proto::Status> status_at(const ControllerAt& controller) {
  LFD_TRY(ControlClient client, ControlClient::connect(controller.endpoint, controller.key_file));
  proto::Request request;
  request.mutable_status();
  LFD_TRY(const proto::Reply reply, client.ask(request, kAnswerPatience));
  return reply.status();
}

testing::AssertionResult becomes(const ControllerAt& controller,
                                 const std::function<bool(const proto::Status& status)>& wanted) {
  const auto deadline = Clock::now() + kClusterPatience;
  while (true) {
    const Result<proto::Status> status = status_at(controller);
    if (!status) return testing::AssertionFailure() << status.error().message();
    if (wanted(*status)) return testing::AssertionSuccess();
    if (Clock::now() >= deadline) {
      return testing::AssertionFailure() << "it has not become so in time: " << status->ShortDebugString();
    }
    std::this_thread::sleep_for(kPause);
  }
}

std::vector<std::string> ctl(const Running& running, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"ctl", "--controller", running.endpoint});
  const auto lfd = start_program("lfd", arguments);
  const auto exit = lfd->wait(kClusterPatience);
  EXPECT_TRUE(exit && exit->succeeded()) << testing::PrintToString(arguments) << testing::PrintToString(lfd->lines());
  return lfd->lines();
}

proto::Status settled_status(const Running& running) {
  EXPECT_TRUE(becomes(running.endpoint, all_nodes_follow));
  const Result<proto::Status> status = status_at(running.endpoint);
  EXPECT_TRUE(status);
  return status ? *status : proto::Status();
}

std::optional<Picture8> written_picture(const std::filesystem::path& folder, std::uint64_t frame,
                                        std::uint32_t module) {
  const auto path = image_path(folder, frame, module, proto::COLOR);
  const auto deadline = Clock::now() + kClusterPatience;
  while (!std::filesystem::exists(path) && Clock::now() < deadline) std::this_thread::sleep_for(kPause);
  const Result<Picture8> picture = read_png(path);
  EXPECT_TRUE(picture) << (picture ? "" : picture.error().message());
  return picture ? std::optional(*picture) : std::nullopt;
}

testing::AssertionResult draws(const ControllerAt& controller, std::uint64_t frames) {
  std::optional<std::uint64_t> first;
  return becomes(controller, [&](const proto::Status& status) {
    const bool whole = status.frame() > 0 && status.stale_modules() == 0;
    if (whole && !first) first = status.frame();
    return first && status.frame() >= *first + frames;
  });
}

proto::PeerStatus peer_in(const proto::Status& status, const std::string& name) {
  const auto peer = std::ranges::find_if(status.peer(), [&](const auto& one) { return one.name() == name; });
  return peer == status.peer().end() ? proto::PeerStatus() : *peer;
}

bool all_nodes_follow(const proto::Status& status) {
  return std::ranges::all_of(status.peer(), [&](const proto::PeerStatus& peer) {
    return peer.role() != proto::NODE || (peer.state() == "ready" && peer.state_hash() == status.state_hash());
  });
}

std::ptrdiff_t lines_with(const Process& process, const std::string& text) {
  const std::vector<std::string> lines = process.lines();
  return std::ranges::count_if(lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

bool says(const Process& process, const std::string& text, std::ptrdiff_t times) {
  const auto deadline = Clock::now() + kClusterPatience;
  while (lines_with(process, text) < times && Clock::now() < deadline) std::this_thread::sleep_for(kPause);
  return lines_with(process, text) >= times;
}

}  // namespace lfd::harness
