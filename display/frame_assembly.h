// Decides which frame is shown: told of images, swaps and nodes, it gives out whole frames and credits. No sockets, no
// clock.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "base/result.h"
#include "calibration/spaces/pixel.h"
#include "display/node_credit.h"
#include "proto/wire.pb.h"
#include "proto/wire/payload.h"

namespace lfd::display {

// So many images are taken at once before frames are shown and credits go out: with more, nodes wait for credits, and
// what is shown waits in memory.
inline constexpr int kImagesPerPass = 8;

inline constexpr int kBufferKinds = proto::BufferKind_ARRAYSIZE;

struct ReceivedImage {
  proto::Image what;
  wire::Payload payload;  // as what.encoding() says (proto/images/image_payload.h); empty where what.empty()
};

// What one module shows. Images are absent where none has ever arrived (or was asked for).
struct ShownModule {
  std::uint64_t frame = 0;  // that the images are of
  bool stale = false;
  std::array<std::shared_ptr<const ReceivedImage>, kBufferKinds> image;  // by proto::BufferKind
};

// All modules of the display, in order; those that are not stale belong to `frame` or did not change up to it.
struct ShownFrame {
  std::uint64_t frame = 0;
  std::vector<ShownModule> modules;
  int fresh_modules = 0;  // not stale
};

// A node sends the images of one frame after those of the frame before, each naming how many there are (of_images). A
// frame is shown once it has been swapped and every module that is not stale comes from the node that drew it, whose
// images of it are all here; frames that can no longer become whole are dropped. Frames are shown in ascending order,
// each once.
//
// Memory, in bytes of payloads. Per node: what waits, as CreditLimits says, and the last image of each module and
// buffer (of which most are shown or wait too); beside them one shown frame. Images without credit are refused.
class FrameAssembly {
 public:
  static constexpr std::size_t kWaitingPerNode_bytes = std::size_t{512} << 20;  // where nothing else is said
  static constexpr std::size_t kMaxFrames = 16;  // that wait at once; the oldest is dropped for a new one
  static constexpr std::size_t kMaxNodes = 256;
  // A frame of which every image is here is shown after this long even if its swap was lost.
  static constexpr Clock::duration kSwapPatience = std::chrono::seconds(1);
  // A node that has left, or has come since the swap, may have lost its connection only: so long it is waited for,
  // after its last sign of life.
  static constexpr Clock::duration kReturnPatience = std::chrono::seconds(1);

  using Owners = std::map<std::uint32_t, std::string>;  // the node that drew it, by module

  // Starts anew for a display of so many modules with images of this size; `owned`: the modules that nodes draw (empty:
  // all). Until then there are no credits. Nodes that are here stay here, with the credits that they hold.
  void configure(int modules, ImageSize image, std::span<const std::uint32_t> owned = {},
                 std::size_t waiting_bytes = kWaitingPerNode_bytes);

  // Facts. `node` is its name.
  // It has a connection, a new one: nothing that is not here yet will come, but what was lost may be sent again. An
  // error where there are too many.
  Status node_came(const std::string& node, Clock::time_point now);
  void node_left(const std::string& node, Clock::time_point now);
  // A later frame has been shown already, or the frame has been given up: its images are of no use.
  bool is_past(std::uint64_t frame) const;
  // An error says why the image was left out; everything else goes on.
  Status image_came(const std::string& node, const proto::Image& what, wire::Payload payload, Clock::time_point now);
  // An image came that is of no use whatever it is.
  void image_passed_over(const std::string& node);
  // owners: of the modules that are not stale; none at all: whoever sends them.
  void swapped(std::uint64_t frame, std::span<const std::uint32_t> stale_modules, const Owners& owners = {});

  // Decisions.
  // The next frame to show, if one is whole; it counts as shown.
  std::optional<ShownFrame> next_frame(Clock::time_point now);
  // So many more images the node may send; they count as given.
  std::uint32_t credit_for(const std::string& node);
  // What it believes to be here is not: it has to begin anew, with another connection or the same.
  bool has_lost_touch(const std::string& node) const;

  std::uint64_t dropped_frames() const { return dropped_frames_; }
  // Images that wait for their frame to be shown, and their bytes.
  std::size_t waiting_images() const;
  std::size_t waiting_bytes() const;

 private:
  using Place = std::pair<std::uint32_t, proto::BufferKind>;
  struct Node {
    bool is_here = false, has_lost_touch = false;
    NodeCredit credit;
    std::uint64_t latest_frame = 0;  // of an image, since it came
    std::uint64_t connection = 0;    // the event that it came
    Clock::time_point last_sign{};
    std::map<Place, std::shared_ptr<const ReceivedImage>> held;  // the last ones that came with a payload
  };
  struct FromNode {
    std::map<std::uint32_t, ShownModule> modules;
    std::uint32_t here = 0, expected = 0;
    std::size_t bytes = 0;
    std::uint64_t connection = 0;  // that the images came by
    bool is_whole() const { return here >= expected; }
  };
  struct Swap {
    std::set<std::uint32_t> stale;
    Owners owners;
    std::uint64_t event = 0;
  };
  struct Pending {
    std::map<std::string, FromNode> nodes;
    std::optional<Swap> swap;
    std::optional<Clock::time_point> latest_arrival;  // of an image
  };
  enum class Fate { kWhole, kWaits, kHopeless };

  // frame_assembly.cc: what comes
  Status check(const proto::Image& what) const;
  Result<std::shared_ptr<const ReceivedImage>> received(Node& node, const proto::Image& what,
                                                        wire::Payload&& payload) const;
  Status place(const std::string& name, Node& node, std::shared_ptr<const ReceivedImage> image, Clock::time_point now);

  // frame_fate.cc: what becomes of it
  bool is_waited_for(std::uint32_t module, const std::optional<Swap>& swap) const;
  const std::string& owner_of(std::uint32_t module, const Pending& pending) const;
  Fate fate(std::uint64_t frame, const Pending& pending, Clock::time_point now) const;
  Fate fate_without(std::uint32_t module, std::uint64_t frame, const Pending& pending, Clock::time_point now) const;
  bool is_passed_over(std::uint32_t module, const std::string& owner, std::uint64_t frame) const;
  bool starves_others(const Pending& pending) const;
  ShownFrame show(std::uint64_t frame, Pending&& pending);
  void drop(std::map<std::uint64_t, Pending>::iterator pending);
  void release(const std::string& name, const FromNode& from);

  ImageSize image_;
  CreditLimits limits_;
  std::vector<bool> owned_;         // by module
  std::vector<std::string> owner_;  // by module: the node its last image came from; empty: none yet
  std::vector<ShownModule> shown_;  // by module
  std::optional<std::uint64_t> last_shown_, latest_swapped_;
  Swap latest_swap_;
  std::map<std::string, Node> nodes_;         // those that are here, and those that were
  std::map<std::uint64_t, Pending> pending_;  // all later than last_shown_
  std::uint64_t dropped_frames_ = 0, events_ = 0;
};

}  // namespace lfd::display
