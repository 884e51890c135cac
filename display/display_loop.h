// The loop of the virtual display: sockets, signals and clock around FrameAssembly and PictureWriter; they decide, this
// does.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "base/clock.h"
#include "base/metric_server.h"
#include "base/service.h"
#include "base/signals.h"
#include "display/daemon.h"
#include "display/display_stats.h"
#include "display/frame_assembly.h"
#include "display/image_peers.h"
#include "display/picture_writer.h"
#include "display/senders.h"
#include "proto/deployment_keys.h"
#include "proto/refusal.h"
#include "proto/wire/socket.h"

namespace lfd::display {

class DisplayLoop {
 public:
  DisplayLoop(const DaemonOptions& options, wire::Context& context, wire::Socket images, wire::Socket control,
              MetricServer* metrics)
      : options_(options),
        context_(context),
        images_(std::move(images)),
        control_(std::move(control)),
        senders_(options.nodes, !is_local_endpoint(images_.endpoint())),
        metrics_(metrics) {
    if (options.out) writer_.emplace(*options.out);
  }

  Status run(StopSignals& signals);

 private:
  // display_loop.cc: the loop and the controller's words
  void wait_for_something(StopSignals& signals);
  void join_or_beat(Clock::time_point now);
  Status hear_control();
  Status take_refusal(const proto::Refused& refused);
  Status welcome(const proto::Envelope& envelope);
  void hear_state();
  bool is_of_another_session(const proto::Envelope& envelope) const;
  void hear_swap(const proto::SwapFrame& swap);
  void serve(Clock::time_point now);  // the service manager and Prometheus

  // display_images.cc: images in, frames and credits out
  void hear_images();
  void hear_image(wire::Message&& message);
  void hear_hello(const wire::Message& message, Clock::time_point now);
  void forget(const std::string& peer, const std::string& why);
  void show();
  void say_shown(std::uint64_t frame, int fresh_modules);
  void say_fate_again(std::uint64_t frame);  // of a past frame: what was said may have been lost
  void give_credits();
  void warn_of_image(const Error& error);

  const DaemonOptions& options_;
  wire::Context& context_;
  wire::Socket images_, control_;
  std::optional<wire::Socket> state_;
  std::optional<PictureWriter> writer_;
  FrameAssembly assembly_;
  Senders senders_;
  ImagePeers peers_{assembly_};
  std::uint64_t session_ = 0;  // of the controller that welcomed this display
  bool welcome_ = false, ended_ = false;
  // The fresh modules of the last frames that were shown, once that was said: a frame is written first.
  std::map<std::uint64_t, std::optional<int>> last_shown_;
  Refusals refusals_;
  bool told_shown_ = true;  // the controller could be told of the last frame
  Clock::duration heartbeat_ = std::chrono::milliseconds(500);
  Clock::time_point next_words_{}, last_heard_{}, last_warning_{};
  std::uint64_t refused_images_ = 0;
  MetricServer* metrics_;  // may be null
  DisplayStats stats_;
  Service service_;
  Clock::time_point next_look_{};  // when those are told again
};

}  // namespace lfd::display
