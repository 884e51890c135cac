// lfd record: writes the show of a running cluster into a file, without taking part in it.
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "base/log.h"
#include "base/signals.h"
#include "cli/ctl_requests.h"
#include "cli/lfd_commands.h"
#include "cli/show_recorder.h"
#include "proto/calibration_file.h"
#include "proto/recording_writer.h"
#include "proto/wire/poll.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;

constexpr auto kTick = 20ms;
constexpr auto kScenePause = 200ms;                  // between questions whether there is a scene
constexpr auto kSilenceToTell = 3s, kSilence = 10s;  // of the controller: it is said; it is lost
constexpr auto kAskAgain = 500ms;                    // for what did not come
constexpr auto kLastAssets = 60s;                    // for assets, once enough of the show is recorded
constexpr auto kLastAssetsOfASignal = 1s;

struct Arguments {
  ControllerAt controller;
  std::filesystem::path out;
  std::optional<double> seconds;
  std::optional<std::uint64_t> frames;
};

proto::Request follow_request() {
  proto::Request request;
  request.mutable_follow();
  return request;
}

// Waits until the controller has a scene. Errors: a signal, no controller.
Result<proto::Follow> first_follow(ControlClient& client, StopSignals& signals) {
  proto::Request status;
  status.mutable_status();
  bool said = false;
  while (true) {
    LFD_TRY(const std::uint64_t id, client.send(follow_request(), kAnswerPatience));
    const auto reply = client.receive(id, kAnswerPatience);
    if (!reply) return Error("the controller does not answer");
    if (reply->error().empty()) return reply->follow();
    LFD_TRY(const proto::Reply now, client.ask(status, kAnswerPatience));
    if (now.status().sequence() > 0) return Error(reply->error());
    if (!std::exchange(said, true)) std::cerr << "waits: " << reply->error() << std::endl;
    wire::wait({}, {signals.descriptor()}, kScenePause);
    if (const auto signal = signals.take()) return Error(fmt::format("ended by signal {}", *signal));
  }
}

// Sockets and clock around ShowRecorder and RecordingWriter.
class Session {
 public:
  static Result<Session> open(const Arguments& arguments, StopSignals& signals) {
    LFD_TRY(const ControllerAt controller, resolved(arguments.controller));
    LFD_TRY(ControlClient client, ControlClient::connect(controller.endpoint, controller.key_file));
    LFD_TRY(const proto::Follow follow, first_follow(client, signals));
    LFD_TRY(auto context, wire::open_context(controller.key_file));
    LFD_TRY(wire::Socket state, wire::connect_subscriber(*context, follow.state_endpoint()));
    LFD_TRY(wire::Socket bulk, wire::connect_dealer(*context, follow.bulk_endpoint(), wire::kChunks));
    const auto display = read_calibration(follow.display());
    if (!display) return display.error().within("the controller's display");
    proto::RecordingHeader header;
    *header.mutable_display() = follow.display();
    header.set_calibration_hash(calibration_hash(*display));
    LFD_TRY(RecordingWriter writer, RecordingWriter::create(arguments.out, std::move(header)));
    return Session(arguments, std::move(client), std::move(context), std::move(state), std::move(bulk),
                   std::move(writer));
  }

  // Until a signal, the wished end, or that of the controller. Errors: the file cannot be written, the controller is
  // lost.
  Status run(StopSignals& signals);

 private:
  struct Enough {
    std::string reason;
    Clock::time_point until;
  };
  Session(const Arguments& arguments, ControlClient client, std::unique_ptr<wire::Context> context, wire::Socket state,
          wire::Socket bulk, RecordingWriter writer)
      : arguments_(arguments),
        context_(std::move(context)),
        client_(std::move(client)),
        state_(std::move(state)),
        bulk_(std::move(bulk)),
        writer_(std::move(writer)) {}

  void hear(Clock::time_point now);
  void ask_for_snapshot(Clock::time_point now);
  void hear_bulk(Clock::time_point now);
  Status write();
  void stop_hearing(const std::string& reason, Clock::time_point until);
  void end_as_wished(StopSignals& signals, Clock::time_point now);
  std::string summary() const;

  const Arguments& arguments_;
  std::unique_ptr<wire::Context> context_;
  ControlClient client_;
  wire::Socket state_, bulk_;
  RecordingWriter writer_;
  ShowRecorder recorder_{wire::kChunk_bytes, arguments_.frames};
  std::optional<std::uint64_t> asked_;  // number of the request for a snapshot
  Clock::time_point ask_again_{}, want_again_{}, last_heard_ = Clock::now();
  std::optional<Clock::time_point> begun_;
  std::optional<Enough> enough_;
  bool misses_controller_ = false;  // which has been said
};

void Session::hear(Clock::time_point now) {
  while (const auto message = state_.receive()) {
    last_heard_ = now;
    misses_controller_ = false;
    if (!enough_) recorder_.heard(message->envelope, now);
  }
}

void Session::ask_for_snapshot(Clock::time_point now) {
  if (!recorder_.wants_snapshot() || enough_) return;
  if (asked_) {
    if (const auto reply = client_.receive(*asked_, Clock::duration::zero())) {
      asked_.reset();
      ask_again_ = now + kAskAgain;
      if (reply->error().empty()) recorder_.snapshot_came(reply->follow().snapshot().state(), now);
    }
  } else if (now >= ask_again_) {
    ask_again_ = now + kAskAgain;
    if (const auto id = client_.send(follow_request(), Clock::duration::zero())) asked_ = *id;
  }
  if (!begun_ && recorder_.has_begun()) {
    begun_ = now;
    std::cout << fmt::format("recording {}\n", arguments_.out.string()) << std::flush;
  }
}

void Session::hear_bulk(Clock::time_point now) {
  AssetGatherer& gatherer = recorder_.gatherer();
  while (const auto message = bulk_.receive()) {
    // It is not asked for again at once: news of the other scene is on its way.
    if (message->envelope.has_not_found()) {
      gatherer.not_found(message->envelope.not_found().hash());
      want_again_ = now + kAskAgain;
    }
    if (!message->envelope.has_chunk()) continue;
    if (const Status came = gatherer.piece_came(message->envelope.chunk(), message->payload.text()); !came)
      log::warn("{}", came.error().message());
  }
  if (now < want_again_) return;
  for (const proto::Want& want : gatherer.next_requests(now)) {
    proto::Envelope request;
    *request.mutable_want() = want;
    if (bulk_.send(request)) continue;
    gatherer.ask_again();
    want_again_ = now + kAskAgain;
    break;
  }
}

Status Session::write() {
  for (proto::RecordingEvent& event : recorder_.take_events()) LFD_TRY_STATUS(writer_.event(std::move(event)));
  for (const ShowRecorder::Asset& asset : recorder_.take_assets())
    LFD_TRY_STATUS(writer_.asset(asset.hash, *asset.content));
  return {};
}

// Enough of the show is there: the assets that are still on their way are waited for, but not longer than this.
void Session::stop_hearing(const std::string& reason, Clock::time_point until) {
  if (!enough_) enough_ = Enough{.reason = reason, .until = until};
}

void Session::end_as_wished(StopSignals& signals, Clock::time_point now) {
  const bool long_enough =
      arguments_.seconds && begun_ && now - *begun_ >= std::chrono::duration<double>(*arguments_.seconds);
  if (long_enough || recorder_.has_enough()) stop_hearing("as much as was asked for", now + kLastAssets);
  if (const auto signal = signals.take()) {
    if (enough_) enough_->until = now;
    stop_hearing(fmt::format("signal {}", *signal), now + kLastAssetsOfASignal);
  }
}

std::string Session::summary() const {
  std::string text =
      fmt::format("{} frames, {} assets, {} bytes", recorder_.begun_frames(), recorder_.assets(), writer_.bytes());
  if (recorder_.left_out_frames() > 0)
    text += fmt::format("; {} frames are not in it: updates were lost on the way", recorder_.left_out_frames());
  if (recorder_.missing_assets() > 0)
    text +=
        fmt::format("; {} assets are not in it: frames of their scenes cannot be replayed", recorder_.missing_assets());
  return text;
}

Status Session::run(StopSignals& signals) {
  std::optional<ShowRecorder::End> end;
  while (!end) {
    wire::wait({&state_, &bulk_}, {signals.descriptor()}, kTick);
    const Clock::time_point now = Clock::now();
    hear(now);
    ask_for_snapshot(now);
    hear_bulk(now);
    LFD_TRY_STATUS(write());
    end_as_wished(signals, now);
    end = recorder_.end();
    if (end) break;
    if (enough_ && (recorder_.gatherer().complete() || now >= enough_->until)) {
      end = ShowRecorder::End{.reason = enough_->reason};
    } else if (now - last_heard_ > kSilence) {
      end = ShowRecorder::End{.reason = fmt::format("nothing was heard of the controller for {} s", kSilence.count()),
                              .is_fault = true};
    } else if (now - last_heard_ > kSilenceToTell && !std::exchange(misses_controller_, true)) {
      log::warn("nothing heard of the controller for {} s; it is waited for until {} s", kSilenceToTell.count(),
                kSilence.count());
    }
  }
  if (!recorder_.has_begun()) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(arguments_.out, ignored)) std::filesystem::remove(arguments_.out, ignored);
    return Error(end->reason + "; nothing was recorded").within(arguments_.out.string());
  }
  LFD_TRY_STATUS(writer_.end(end->reason));
  std::cout << fmt::format("{}: {}; ended: {}\n", arguments_.out.string(), summary(), end->reason);
  return end->is_fault ? Status(Error(end->reason + "; the recording ends there")) : Status();
}

int record(const Arguments& arguments) {
  StopSignals signals;
  auto session = Session::open(arguments, signals);
  if (!session) return fail(session.error());
  const Status done = session->run(signals);
  return done ? end_of_output() : fail(done.error());
}

}  // namespace

void add_record_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = add_command(app, "record", "Record the show of a running cluster into a file", exit_code,
                                  [arguments] { return record(*arguments); });
  add_controller_options(*command, arguments->controller);
  command->add_option("--out", arguments->out, "File to write; one that exists is not overwritten")->required();
  CLI::Option* seconds = command->add_option("--seconds", arguments->seconds, "End after so long (default: Ctrl-C)");
  seconds->check(number_within(0.01, 1e6));
  command->add_option("--frames", arguments->frames, "End after so many frames")
      ->check(whole_number_within(1, std::int64_t{1} << 40))
      ->excludes(seconds);
  command->footer(
      "Ends on Ctrl-C too, and with the controller; a controller that is started anew ends the recording with exit "
      "code 1,\nsince its frames count from 0 again. What was written until then can be replayed, whatever happens.");
}

}  // namespace lfd
