// The loop around WatchTable.
#include "cli/status_watch.h"

#include <algorithm>
#include <optional>

#include "base/signals.h"
#include "cli/terminal.h"
#include "cli/watch_table.h"
#include "proto/wire/poll.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;

constexpr auto kLook = 50ms;                    // a signal ends it within that
constexpr Clock::duration kLeastPatience = 2s;  // with a controller that is busy

class Watch {
 public:
  Watch(ControllerAt controller, Clock::duration every) : controller_(std::move(controller)), every_(every) {}

  Status run();

 private:
  bool is_ended() { return ended_ = ended_ || signals_.take().has_value(); }
  void pause(Clock::duration at_most);
  Result<std::optional<proto::Status>> ask();

  StopSignals signals_;  // before anything starts a thread
  ControllerAt controller_;
  Clock::duration every_;
  std::optional<ControlClient> client_;
  bool ended_ = false;
};

void Watch::pause(Clock::duration at_most) {
  if (!is_ended()) wire::wait({}, {signals_.descriptor()}, at_most);
}

// Absent where no answer comes in time, or a signal does.
Result<std::optional<proto::Status>> Watch::ask() {
  const auto deadline = Clock::now() + std::max(every_, kLeastPatience);
  const auto may_go_on = [&] { return !is_ended() && Clock::now() < deadline; };
  if (!client_) {
    auto connected =
        connect_controller(controller_);  // without an endpoint: where the cluster listens may have changed
    if (!connected) return std::optional<proto::Status>();
    client_ = *std::move(connected);
  }
  proto::Request request;
  request.mutable_status();
  auto id = client_->send(request, 0ms);
  while (!id && may_go_on()) {
    pause(kLook);
    id = client_->send(request, 0ms);
  }
  while (id && may_go_on()) {
    const auto reply = client_->receive(*id, kLook);
    if (!reply) continue;
    if (!reply->error().empty()) return Error(reply->error());
    return std::optional(reply->status());
  }
  client_.reset();
  return std::optional<proto::Status>();
}

Status Watch::run() {
  LFD_TRY(client_, connect_controller(controller_));
  WatchTable table;
  LiveOutput output;
  while (!is_ended()) {
    const auto next = Clock::now() + every_;
    LFD_TRY(const std::optional<proto::Status> status, ask());
    if (is_ended()) break;
    const auto now = Clock::now();
    if (!output.show(status ? table.answered(*status, now) : table.unanswered(now, output.is_terminal())))
      return Error("standard output cannot be written");
    while (!is_ended() && Clock::now() < next) pause(next - Clock::now());
  }
  return {};
}

}  // namespace

Status watch_status(const ControllerAt& controller, Clock::duration every) { return Watch(controller, every).run(); }

}  // namespace lfd
