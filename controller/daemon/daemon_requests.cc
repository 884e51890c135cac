// Requests of control clients and their replies.
#include "base/log.h"
#include "controller/daemon/daemon.h"
#include "proto/calibration_file.h"

namespace lfd::controller {
namespace {

constexpr std::uint32_t kMostFrames = FrameLog::kRemembered;  // of one request: their reports have to be remembered

Status check_length(std::size_t bytes) {
  constexpr std::size_t kMost_bytes = wire::kSmallMessages.max_part_bytes - 1024;  // the envelope has its share
  if (bytes <= kMost_bytes) return {};
  return Error(fmt::format("the reply of {} MiB does not fit into a message of {} MiB", bytes >> 20,
                           wire::kSmallMessages.max_part_bytes >> 20));
}

}  // namespace

void Daemon::reply(const std::string& client, std::uint64_t id, const Status& done) {
  proto::Reply answer;
  answer.set_id(id);
  if (!done) answer.set_error(done.error().message());
  reply(client, std::move(answer));
}

void Daemon::reply(const std::string& client, proto::Reply answer) {
  if (const Status fits = check_length(answer.ByteSizeLong()); !fits)
    return reply(client, answer.id(), Error(fits.error().message() + "; ask for fewer frames at a time"));
  proto::Envelope envelope;
  *envelope.mutable_reply() = std::move(answer);
  send(client, std::move(envelope));
}

void Daemon::answer_follow(const std::string& client, std::uint64_t id) {
  if (!stage_.has_scene()) return reply(client, id, Error("no scene is there yet"));
  if (!handouts_.has_room())
    return reply(client, id, Error("too many who asked for the scene do not read it; ask again later"));
  std::string state = snapshot().SerializeAsString();
  if (const Status fits = check_length(state.size()); !fits) return reply(client, id, fits);
  proto::Envelope envelope;
  envelope.mutable_reply()->set_id(id);
  proto::Follow& follow = *envelope.mutable_reply()->mutable_follow();
  follow.set_state_endpoint(links_.state.endpoint());
  follow.set_bulk_endpoint(links_.bulk.endpoint());
  *follow.mutable_display() = write_calibration(options_.deployment.display);
  send(client, std::move(envelope), handouts_.give(std::move(state)));
}

void Daemon::take_request(const wire::Message& message, Clock::time_point now) {
  const proto::Request& request = message.envelope.request();
  if (const Status may = may_ask_for(message, now); !may) return reply(message.peer, request.id(), may);
  const auto change = [&](const Result<proto::Update>& update) {
    if (update) publish(*update);
    reply(message.peer, request.id(), update ? Status() : Status(update.error()));
  };
  // True where the answer comes later.
  const auto start = [&](const Result<bool>& started) {
    if (!started) reply(message.peer, request.id(), started.error());
  };
  if (const Status may = may_ask(request); !may) return reply(message.peer, request.id(), may);
  switch (request.what_case()) {
    case proto::Request::kStatus: {
      proto::Reply answer;
      answer.set_id(request.id());
      *answer.mutable_status() = status(now);
      return reply(message.peer, std::move(answer));
    }
    case proto::Request::kFollow:
      return answer_follow(message.peer, request.id());
    case proto::Request::kRoi:
      return change(stage_.set_roi(request.roi()));
    case proto::Request::kRender:
      return change(stage_.set_render(request.render()));
    case proto::Request::kAo:
      return change(stage_.set_ao(request.ao()));
    case proto::Request::kPattern:
      return change(stage_.set_pattern(request.pattern()));
    case proto::Request::kSceneFile:
      return start(start_scene(message));
    case proto::Request::kFrames:
      return start(start_frames(message));
    case proto::Request::kQuit:
      end_ = "a client asked for it";
      return reply(message.peer, request.id(), {});
    case proto::Request::WHAT_NOT_SET:
      return reply(message.peer, request.id(), Error("an empty request"));
  }
}

Result<bool> Daemon::start_scene(const wire::Message& message) {
  if (loader_.busy() || change_.is_pending()) return Error("another scene is being loaded");
  const proto::Request& request = message.envelope.request();
  loader_.start(std::filesystem::path(request.scene_file()), message.peer, request.id());
  return true;
}

Result<bool> Daemon::start_frames(const wire::Message& message) {
  const proto::Request& request = message.envelope.request();
  const proto::FramesRequest& frames = request.frames();
  if (asked_) return Error("frames are being drawn for another client");
  if (frames.count() == 0 || frames.count() > kMostFrames) {
    return Error(fmt::format("count: {}; 1 to {} frames are possible", frames.count(), kMostFrames));
  }
  asked_ = FramesAsked{.client = message.peer,
                       .id = request.id(),
                       .first = barrier_.next_frame(),
                       .count = frames.count(),
                       .time_modules = frames.time_modules(),
                       .error = {}};
  pacing_.ask_for(frames.count());
  log_.remember(frames.count());
  if (const auto update = stage_.set_buffers(frames.buffers())) publish(*update);
  return true;
}

}  // namespace lfd::controller
