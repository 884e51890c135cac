// The render node as a process: follows the state, gathers assets, has frames drawn, says how far it is, sends images.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/metric_server.h"
#include "base/service.h"
#include "base/signals.h"
#include "proto/asset_gatherer.h"
#include "proto/deployment.pb.h"
#include "proto/refusal.h"
#include "proto/state_follower.h"
#include "proto/wire/socket.h"
#include "rendernode/node/file_sink.h"
#include "rendernode/node/frame_encoder.h"
#include "rendernode/node/image_outbox.h"
#include "rendernode/node/node_stats.h"
#include "rendernode/node/render_thread.h"

namespace lfd::node {

struct DaemonOptions {
  std::string name;                       // as in the deployment
  std::string controller;                 // control endpoint
  int gpu = -1;                           // of --list-gpus; -1: the first that works
  std::string calibration_hash;           // of the deployment's display, which the controller's must equal
  std::string out;                        // folder of the sink `files`
  std::shared_ptr<MetricServer> metrics;  // may be null
  std::string key_file;                   // empty: without keys
};

class Daemon {
 public:
  static Result<std::unique_ptr<Daemon>> open(DaemonOptions options);

  // Runs until a signal or the controller's Quit (success), a refusal, or a GPU that cannot be used. A controller that
  // is away is waited for.
  Status run(StopSignals& signals);

  // Ends the drawing. False where a frame under way does not end in time: the process must not wait for it.
  bool stop_drawing_within(Clock::duration patience);

 private:
  // A frame that was announced and not yet given to the render thread, and the hash of the state that it is of: empty
  // where that was not here when it was announced.
  struct Begun {
    proto::BeginFrame begin;
    std::string hash;
  };
  // What each frame under way is drawn from.
  struct FrameState {
    std::shared_ptr<const proto::State> state;
    std::string hash;
  };
  // A frame whose images are being encoded, or wait for the outbox.
  struct EncodedFrame {
    std::uint64_t frame = 0;
    proto::NodeReport report;
    std::optional<std::vector<OutgoingImage>> images;  // once they are encoded
  };

  // A scene that is to come, and the thread that builds and draws it once for nobody.
  struct Preparation {
    std::uint64_t number = 0;
    std::shared_ptr<const proto::State> state;
    std::unique_ptr<RenderThread> drawing;
    bool is_built = false;
  };

  Daemon(DaemonOptions options, std::unique_ptr<wire::Context> context, wire::Socket control)
      : options_(std::move(options)), context_(std::move(context)), control_(std::move(control)) {}

  // daemon.cc: the loop and the controller's words to this node
  void wait_for_something(const StopSignals& signals) const;
  void join_or_beat(Clock::time_point now);
  Status hear_control();
  Status take_refusal(const proto::Refused& refused);
  Status welcome(const proto::Welcome& message, std::uint64_t session);
  // These are its modules from now on; what it drew of others ends. The thread that draws them stays where it draws the
  // very same.
  Status take_share(std::uint64_t share, const DisplayCalibration& display, std::vector<std::uint32_t> modules);
  void retire_drawing();
  void say(proto::Envelope envelope);
  void serve(Clock::time_point now);  // the service manager and Prometheus

  // daemon_state.cc: the state and its assets
  void hear_state();
  void take_snapshot(const proto::Snapshot& snapshot);
  void follow_assets();
  void hear_bulk();

  // daemon_ready.cc: when it may be counted on
  bool holds_state() const;  // the last that was told, with all its assets
  bool can_draw() const;     // the context is there, a first picture is drawn, and the display takes images
  std::string hash_to_say() const;
  void rehearse(Clock::time_point now);
  void rehearsal_ended(const std::string& error);

  // daemon_scenes.cc: a scene that is to come is built beside the one that is shown
  void take_prepare(const proto::Prepare& message);
  void build_prepared();
  void take_prepared_events();
  void say_prepared(const std::string& error);
  void forget_prepared();
  void drop_prepared();
  bool is_prepared_shown() const;  // by the newest state
  bool shows_prepared(const Begun& begun) const;
  void switch_to_prepared();
  void switch_at_rest();

  // daemon_frames.cc: frames and images
  bool draws(const proto::BeginFrame& begin) const;  // this node is named
  void take_begin(const proto::BeginFrame& begin);
  void begin_frames();
  bool can_show(const Begun& begun) const;
  Status take_events();
  Status check_drawing(Clock::time_point now);  // that no driver hangs
  Status take_events_of(RenderThread& thread);
  std::vector<OutgoingImage> outgoing(std::uint64_t frame, const FrameResult& result) const;
  void say_ready(std::uint64_t frame, proto::NodeReport report);
  void say_dropped(std::uint64_t frame, proto::NodeReport report);
  void hand_on_waiting();
  bool hand_on_encoded();
  bool hand_on_drawn();
  bool hand_to_encoder(FrameEvent& event);
  void restart_images(const proto::Stream& stream);
  void use_images_endpoint(const std::string& endpoint);
  void hear_display();
  void send_images();

  DaemonOptions options_;
  std::unique_ptr<wire::Context> context_;
  wire::Socket control_;
  std::optional<wire::Socket> state_socket_, bulk_, images_;
  std::string images_endpoint_;

  StateFollower follower_;
  AssetGatherer gatherer_{wire::kChunk_bytes};
  // The last state of which every asset is here, and those assets.
  std::shared_ptr<const proto::State> ready_state_;
  std::shared_ptr<const Assets> ready_assets_;
  std::string ready_hash_;

  std::uint64_t session_ = 0;  // of the controller that welcomed it
  std::uint64_t share_ = 0;    // the number of what drawing_ draws
  std::uint64_t epoch_ = 0;    // how often it was given a share: frames of before are of no use
  std::optional<DisplayCalibration> display_;
  std::vector<std::uint32_t> modules_;
  std::unique_ptr<RenderThread> drawing_;
  // The one before it, until its last frames are out: it drew another scene.
  std::unique_ptr<RenderThread> finishing_;
  std::optional<Preparation> preparation_;
  std::uint64_t prepared_shown_ = 0;     // the number that the state's scene was prepared under; 0: it was not
  std::uint64_t prepared_sequence_ = 0;  // of the update that shows it
  bool drawing_started_ = false;         // its context is there
  // A picture drawn for nobody with the assets at hand: asked for; done. How many are under way, and the last error.
  bool rehearses_ = false, rehearsed_ = false;
  int rehearsals_ = 0;
  std::string rehearsal_error_;
  Clock::time_point next_rehearsal_{};
  // Of earlier welcomes, still in a frame that nobody waits for.
  std::vector<std::unique_ptr<RenderThread>> retired_;
  std::deque<Begun> begun_;
  std::optional<std::uint64_t> newest_begun_;  // of this share
  std::deque<proto::Ready> said_ready_;        // of the last frames: what was said may have been lost
  std::map<std::uint64_t, FrameState> states_;
  ImageOutbox outbox_;
  std::optional<FileSink> files_;
  std::deque<FrameEvent> waiting_;  // frames whose images wait for the sink
  proto::Stream stream_;
  FrameEncoder encoder_;
  std::optional<EncodedFrame> encoded_;

  NodeStats stats_;
  Service service_;
  Clock::time_point next_look_{};  // when those are told again

  bool welcome_ = false, may_drop_ = false, ended_ = false;
  Refusals refusals_;
  bool hears_state_ = false;  // a pulse has come: no begin will be missed, so the controller may count on this node
  proto::Deployment::Sink sink_ = proto::Deployment::DISPLAY;
  Clock::duration heartbeat_ = std::chrono::milliseconds(500), hang_ = std::chrono::minutes(10);
  Clock::time_point last_check_{}, awake_since_{};  // of the drawing; this process was stopped before that
  Clock::time_point next_words_{}, last_heard_{}, next_snapshot_request_{};
  std::uint64_t dropped_frames_ = 0;
};

}  // namespace lfd::node
