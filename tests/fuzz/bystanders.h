// What the other messages reach, without sockets: limits and rights at the controller, its statistics and their texts,
// pieces of assets, a change of scenes, greetings, credits and welcomes. Beside Peers, which holds state and frames.
#pragma once

#include <string>
#include <string_view>

#include "base/clock.h"
#include "controller/cluster_stats.h"
#include "controller/join_limiter.h"
#include "controller/scene_change.h"
#include "display/senders.h"
#include "proto/asset_gatherer.h"
#include "proto/key_files.h"
#include "proto/scene_data.h"
#include "rendernode/node/image_outbox.h"

namespace lfd::fuzz {

class Bystanders {
 public:
  Bystanders();

  // Aborts where something is not as it must be.
  void take(const std::string& sender, const proto::Envelope& envelope, Clock::time_point now);

 private:
  void to_rights(const std::string& sender, const proto::Envelope& envelope, Clock::time_point now);
  void to_stats(const std::string& sender, const proto::Envelope& envelope, Clock::time_point now);
  void to_scene_change(const std::string& sender, const proto::Envelope& envelope);
  void to_images(const std::string& sender, const proto::Envelope& envelope, Clock::time_point now);

  AllowList allowed_;
  controller::JoinLimiter limiter_;
  controller::ClusterStats stats_{Clock::time_point(std::chrono::seconds(100))};
  controller::SceneChange change_;
  AssetGatherer gatherer_{1 << 20};
  Assets assets_;
  display::Senders senders_{{}, true};
  node::ImageOutbox outbox_;
  std::uint64_t frame_ = 0;
};

}  // namespace lfd::fuzz
