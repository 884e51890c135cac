// Decides which node each sender of images is, and what it is told: credits, or that it has to greet anew.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/result.h"
#include "display/frame_assembly.h"

namespace lfd::display {

// A peer is a connection: one that was lost and made anew is another peer, and its node does not know it. So whoever
// sends images without having said hello is told that nothing of them is here (Credit.anew without images), and says
// hello; the answer to that is the first credit (Credit.anew). A second hello of the same peer changes nothing: what
// was said to it before arrives. Empty credits find out which peers are gone.
class ImagePeers {
 public:
  static constexpr Clock::duration kProbePause = std::chrono::milliseconds(500);

  explicit ImagePeers(FrameAssembly& assembly) : assembly_(assembly) {}

  // Facts.
  // True where the node is another peer now; an error where there are too many.
  Result<bool> hello(const std::string& peer, const std::string& node, Clock::time_point now);
  // The node that sent an image; absent where the peer has not said hello.
  std::optional<std::string> sender(const std::string& peer);
  // It cannot be told anything; the node that it was, if any.
  std::optional<std::string> gone(const std::string& peer, Clock::time_point now);
  // Nothing that anybody was promised or has sent holds any more.
  void restart(Clock::time_point now);

  // Decisions: what is to be told to whom; it counts as told.
  struct Words {
    std::string peer;
    proto::Credit credit;
  };
  std::vector<Words> words(Clock::time_point now);

 private:
  struct Peer {
    std::string node;
    bool has_credit = false;  // the first one has been given
  };

  void forget(std::map<std::string, Peer>::iterator peer, Clock::time_point now);

  FrameAssembly& assembly_;
  std::map<std::string, Peer> peers_;  // that have said hello
  std::set<std::string> strangers_;    // to be told that they have to
  Clock::time_point probed_at_{};
};

}  // namespace lfd::display
