// All who take messages, without sockets: a controller's deciding classes, a node's and a display's, told of whatever
// comes, and held to what must be true of them at any time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/clock.h"
#include "controller/frame_barrier.h"
#include "controller/frame_log.h"
#include "controller/membership.h"
#include "controller/stage.h"
#include "display/frame_assembly.h"
#include "proto/asset_gatherer.h"
#include "proto/state_follower.h"
#include "tests/fuzz/bystanders.h"

namespace lfd::fuzz {

// A message as it comes from a socket; absent where the socket would leave it out.
std::optional<proto::Envelope> envelope_of(std::string_view bytes);

// The nodes "left" and "right" have joined from "L" and "R", a display from "D"; a scene is shown, and a frame is open.
class Peers {
 public:
  // Of the asset of this content pieces may be sent: the node wants it.
  static constexpr std::string_view kAsset = "an asset of three pieces";
  static constexpr std::uint32_t kPiece_bytes = 10;

  Peers();

  // Everybody who takes such a message takes it; it comes from `sender`.
  void take(const std::string& sender, const proto::Envelope& envelope, std::string_view payload);

  // Time goes on, and whoever decides by it decides.
  void wait(Clock::duration how_long);

  // Aborts where something is not as it must be.
  void check() const;

 private:
  void to_controller(const std::string& sender, const proto::Envelope& envelope);
  void to_stage(const proto::Request& request);
  void to_node(const proto::Envelope& envelope, std::string_view payload);
  void to_display(const std::string& sender, const proto::Envelope& envelope, std::string_view payload);
  void tick();

  Clock::time_point now_{std::chrono::seconds(100)};
  controller::Membership members_;
  controller::FrameBarrier barrier_{std::chrono::milliseconds(50)};
  controller::FrameLog log_;
  controller::Stage stage_;
  std::optional<std::uint64_t> last_swap_;
  StateFollower follower_;
  AssetGatherer gatherer_{kPiece_bytes};
  display::FrameAssembly assembly_;
  std::optional<std::uint64_t> last_shown_;
  Bystanders bystanders_;
};

}  // namespace lfd::fuzz
