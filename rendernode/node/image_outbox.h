// Decides which images go to the display now, what of them it has already, and when it has to be greeted.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "proto/wire.pb.h"
#include "proto/wire/payload.h"

namespace lfd::node {

struct OutgoingImage {
  proto::Image header;
  wire::Payload payload;
};

// Whole frames in order, as far as the display's credits reach; at most one frame is on its way. An image whose payload
// is the very one (the same bytes in memory) that the display got last of its module and buffer travels without it.
//
// Nobody tells a node that a connection was lost and made anew: images may be lost, and the display then knows neither
// who sends nor what was sent. Its Credit that begins `anew` says so: what was said and sent before counts no more, and
// the frame on its way, or the last one, goes once more from its beginning.
class ImageOutbox {
 public:
  static constexpr Clock::duration kHelloPause = std::chrono::milliseconds(300);
  static constexpr Clock::duration kContentHelloPause = std::chrono::seconds(1);

  // What a frame costs as things are: bytes of payloads, and images that travel without one since they did not change.
  struct Load {
    std::uint64_t bytes = 0;
    std::uint32_t unchanged = 0;
  };

  // Whether the images of another frame can be taken: those of the last one have all gone.
  bool idle() const { return next_ == frame_.size(); }

  // Takes a frame's images; only while idle.
  Load push(std::vector<OutgoingImage> images);

  // The display has greeted back: images will be taken.
  bool is_known() const { return known_; }

  // Forgets the frame on its way: it is of no use any more.
  void clear();

  // The display's words.
  void credit_came(const proto::Credit& credit);

  // There is another display, or none: nothing holds that the last one said.
  void reconnected();

  // The next image, if one waits and there is credit for it; sent() once it has gone.
  std::optional<OutgoingImage> next() const;
  void sent();

  // Whether the display has to be greeted now; the greeting counts as sent. Often as long as it has given no credit, or
  // images wait for some, and else now and then: a display that knows the connection passes that over, and one that
  // does not has lost what was sent.
  bool greets(Clock::time_point now);

 private:
  using Place = std::pair<std::uint32_t, proto::BufferKind>;
  struct Held {
    std::uint64_t frame = 0;
    wire::Payload payload;
  };
  static Place place_of(const OutgoingImage& image) { return {image.header.module(), image.header.buffer()}; }
  const Held* held(const OutgoingImage& image) const;  // what the display has of it already

  std::vector<OutgoingImage> frame_;  // kept until the next one comes
  std::size_t next_ = 0;              // that has not gone
  std::map<Place, Held> held_;        // by the display, as far as this node knows
  std::uint64_t credit_ = 0;
  bool known_ = false;  // to the display
  std::optional<Clock::time_point> greeted_at_;
};

}  // namespace lfd::node
