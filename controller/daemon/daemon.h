// The controller's loop: what comes in on sockets is told to the deciding classes, what they decide goes out.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/metric_server.h"
#include "base/now_and_then.h"
#include "base/service.h"
#include "base/signals.h"
#include "controller/assignment.h"
#include "controller/cluster_stats.h"
#include "controller/daemon/links.h"
#include "controller/daemon/scene_loader.h"
#include "controller/frame_barrier.h"
#include "controller/frame_log.h"
#include "controller/handouts.h"
#include "controller/join_limiter.h"
#include "controller/late_nodes.h"
#include "controller/membership.h"
#include "controller/pacing.h"
#include "controller/replay/replay.h"
#include "controller/scene_change.h"
#include "controller/shares.h"
#include "controller/stage.h"

namespace lfd::controller {

class Daemon {
 public:
  struct Options {
    Deployment deployment;
    std::vector<std::string> only_modules;  // empty: all
    std::optional<Replay> replay = {};      // shown instead of the deployment's scene
    bool idle = false;                      // no frame until frames are asked for; those have no deadline
    std::shared_ptr<MetricServer> metrics;  // told the cluster's metrics; may be null
    std::string key_file;                   // empty: without keys
  };

  // Binds the sockets; nothing is loaded yet.
  static Result<std::unique_ptr<Daemon>> open(Options options);

  const std::string& control_endpoint() const { return links_.control.endpoint(); }

  // Runs until a signal or a client ends it; the error is that of the first scene. Says Quit to all before it returns.
  Status run(StopSignals& signals);

  // True where a scene was being loaded at the end: its thread cannot be waited for.
  bool loading() const { return loader_.busy(); }

 private:
  static constexpr int kRefusedJoins = 8;  // that the log tells of in a row
  static constexpr const char* kDisplayIsOut = "the display is out, and has not shown every frame";

  // A client's wish for a number of frames, and how far it is.
  struct FramesAsked {
    std::string client;
    std::uint64_t id = 0;
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    bool time_modules = false;
    std::string error;  // of the first frame that a node could not draw
  };

  // A frame that was announced and not swapped.
  struct OpenFrame {
    Assignment drawn_by;
    proto::BeginFrame begin;
  };

  Daemon(Options options, Links links, std::unique_ptr<wire::Context> context, Stage stage, Assignment assignment);

  // daemon.cc: the loop
  Status start_show();
  void take_control(const wire::Message& message, Clock::time_point now);
  void take_want(const wire::Message& message, Clock::time_point now);
  void tick(Clock::time_point now);
  Clock::time_point wake_at() const;
  void publish(proto::Envelope envelope);
  void publish(const proto::Update& update);
  void send(const std::string& address, proto::Envelope envelope, const wire::Payload& payload = {});

  // daemon_peers.cc: who takes part
  void take_join(const wire::Message& message, Clock::time_point now);
  void take_heartbeat(const wire::Message& message);
  void welcome(const Peer& peer, Clock::time_point now);
  void peer_is_gone(const std::string& name, const char* why);
  void peer_is_back(const Peer& peer);
  void refuse(const std::string& address, proto::Refused refused);
  proto::Snapshot snapshot() const;
  void send_snapshot(const std::string& address);
  void publish_images_endpoint();
  std::string images_endpoint() const;
  bool has_deadline() const { return options_.deployment.pacing.deadline.count() > 0; }

  // daemon_shares.cc: who draws what
  std::map<std::string, Presence> presence(Clock::time_point now) const;
  void settle_shares(Clock::time_point now);
  Assignment drawing(Clock::time_point now) const { return shares_.drawing(presence(now)); }
  // Nobody comes any more who would draw the node's modules, or somebody is ready to.
  bool is_settled(const std::string& node, Clock::time_point now) const;

  // daemon_scenes.cc: scenes as they come
  Status take_scene(SceneArrival arrival, Clock::time_point now);
  void prepares_too(const Peer& peer);  // a node that comes, or draws other modules, while the change is pending
  void settle_scene(Clock::time_point now);
  void show_next_scene(Clock::time_point now);
  void refuse_next_scene(const Error& why);
  const Assets* assets_for(const std::string& hash) const;
  // daemon_strangers.cc: who may
  bool lets_join(const wire::Message& message, Clock::time_point now);  // else it is refused, or passed over
  void refuse_join(const wire::Message& message, const Error& why, Clock::time_point now);
  bool seems_repeated(const wire::Message& message, Clock::time_point now);
  bool borrows_address(const wire::Message& message, Clock::time_point now);
  Status may_ask_for(const wire::Message& message, Clock::time_point now);

  // daemon_frames.cc: the life of frames
  void advance(Clock::time_point now);
  bool may_begin(Clock::time_point now) const;
  void begin_frame(Clock::time_point now);
  void take_ready(const Peer& peer, proto::Ready ready, Clock::time_point now);
  void take_shown(const std::string& display, const proto::Shown& shown, Clock::time_point now);
  void finish(const FrameBarrier::Swap& swap, Clock::time_point now);
  // The frames that were swapped and not shown will not be: an error for the client that asked for them, or the replay.
  void lose_unshown(const std::string& why);
  // Without a deadline, what was lost on the way would be waited for without end: it is said again.
  void say_again(Clock::time_point now);
  void answer_frames_asked(Clock::time_point now);
  // A display that died, or that lost images to a deadline, will not show the last frame.
  bool is_never_shown(Clock::time_point now) const;
  bool has_display_sink() const;

  // daemon_replay.cc: a recorded show instead of a scene
  Status start_replay();
  bool is_due(Clock::time_point now) const;  // a frame: by the recording, or by the pace
  bool waits_for_every_node() const;
  bool take_cue();  // false: the recording cannot be shown any further
  void cue_begun(Clock::time_point now);
  // Of a node that has drawn: whether it was what was recorded.
  void drawn_of_replay(const Peer& peer, const proto::Ready& ready);
  void end_replay(Clock::time_point now);  // once all of it is shown
  Status may_ask(const proto::Request& request) const;

  // daemon_requests.cc: control clients
  void take_request(const wire::Message& message, Clock::time_point now);
  Result<bool> start_frames(const wire::Message& message);
  Result<bool> start_scene(const wire::Message& message);
  void answer_follow(const std::string& client, std::uint64_t id);
  void reply(const std::string& client, std::uint64_t id, const Status& done);
  // An error in place of what no message can hold.
  void reply(const std::string& client, proto::Reply answer);

  // daemon_status.cc: what others see of it
  proto::Status status(Clock::time_point now) const;
  void serve(Clock::time_point now);  // the service manager and Prometheus

  Options options_;
  std::unique_ptr<wire::Context> context_;
  Links links_;
  SceneLoader loader_;
  SceneChange change_;
  std::optional<SceneArrival> next_scene_;  // while the change is pending
  Stage stage_;
  const std::uint64_t session_;  // of this life of the controller
  Assignment assignment_;        // as the deployment has it
  Shares shares_;
  std::map<std::uint64_t, OpenFrame> open_;
  std::map<std::uint64_t, proto::SwapFrame> unshown_;  // of frames that were asked for, or replayed, without a deadline
  std::optional<Clock::time_point> first_shown_;       // when the first scene was there
  Membership members_;
  JoinLimiter limiter_;
  Handouts handouts_;
  // In the log: refusals of requests, of joins and of whose key is another; pieces of assets and answers to strangers
  // that nobody reads.
  NowAndThen refusals_, refused_joins_{kRefusedJoins}, borrowed_, unread_pieces_, unread_answers_;
  FrameBarrier barrier_;
  controller::Pacing pacing_;
  FrameLog log_;
  ClusterStats stats_{Clock::now()};
  Service service_;
  Clock::time_point next_look_{};  // when others are told again
  std::optional<FramesAsked> asked_;
  LateNodes late_;
  std::map<std::string, std::string> said_errors_;  // of nodes: that of the last frame, so that each is logged once
  std::optional<Clock::time_point> last_swap_;
  Clock::time_point next_pulse_;
  std::optional<std::string> end_;  // why the loop ends
  Status replay_failed_;            // why the recording could not be shown to its end
};

}  // namespace lfd::controller
