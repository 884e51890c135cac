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
#include <vector>

#include "base/clock.h"
#include "base/result.h"
#include "calibration/spaces/pixel.h"
#include "proto/wire.pb.h"
#include "proto/wire/payload.h"

namespace lfd::display {

inline constexpr int kBufferKinds = proto::BufferKind_ARRAYSIZE;

struct ReceivedImage {
  proto::Image what;
  wire::Payload pixels;  // rows from the top; empty where what.empty()
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
// frame is shown once it has been swapped and every module that is not stale comes from a node whose images of it are
// all here; frames that can no longer become whole are dropped. Frames are shown in ascending order, each once.
//
// Memory: per node, images that wait plus credits given out are at most the larger of one frame of its images and the
// smaller of kFramesPerNode frames and kWaitingPerNode_bytes; beside them one shown frame is kept. Images without
// credit are refused.
class FrameAssembly {
 public:
  static constexpr std::uint32_t kFramesPerNode = 2;
  static constexpr std::size_t kWaitingPerNode_bytes = std::size_t{512} << 20;
  static constexpr std::size_t kMaxFrames = 16;  // that wait at once; the oldest is dropped for a new one
  static constexpr std::uint32_t kMaxImagesPerFrame = 1024 * kBufferKinds;
  // A frame of which every image is here is shown after this long even if its swap was lost.
  static constexpr Clock::duration kSwapPatience = std::chrono::seconds(1);

  // Starts anew for a display of so many modules with images of this size; `owned`: the modules that nodes draw (empty:
  // all). Until then there are no credits. Credits that nodes already hold stay theirs.
  void configure(int modules, ImageSize image, std::span<const std::uint32_t> owned = {});

  // Facts. `node` is any name that stays the same while the node is connected.
  void node_came(const std::string& node);
  void node_left(const std::string& node);
  // A later frame has been shown already: its images are of no use.
  bool is_past(std::uint64_t frame) const { return last_shown_ && frame <= *last_shown_; }
  // An error says why the image was left out; everything else goes on.
  Status image_came(const std::string& node, const proto::Image& what, wire::Payload pixels, Clock::time_point now);
  void swapped(std::uint64_t frame, std::span<const std::uint32_t> stale_modules);

  // Decisions.
  // The next frame to show, if one is whole; it counts as shown.
  std::optional<ShownFrame> next_frame(Clock::time_point now);
  // So many more images the node may send; they count as given.
  std::uint32_t credit_for(const std::string& node);

  std::uint64_t dropped_frames() const { return dropped_frames_; }
  // Images that wait for their frame to be shown.
  std::size_t waiting_images() const;

 private:
  struct Node {
    std::uint32_t credit = 0;   // given and not used
    std::uint32_t waiting = 0;  // images of it in pending_
    std::uint32_t allowed = 1;  // bound of both together
    std::uint64_t latest_frame = 0;
  };
  struct FromNode {
    std::uint32_t here = 0, expected = 0;
  };
  struct Module {
    std::string node;
    ShownModule images;
  };
  struct Pending {
    std::map<std::string, FromNode> nodes;
    std::map<std::uint32_t, Module> modules;
    std::optional<std::set<std::uint32_t>> stale;     // once swapped
    std::optional<Clock::time_point> latest_arrival;  // of an image
  };
  enum class Fate { kWhole, kWaits, kHopeless };

  std::uint32_t first_allowance() const;
  Status check(const Node& node, const proto::Image& what, std::size_t payload_bytes) const;
  Fate fate(std::uint64_t frame, const Pending& pending, const std::set<std::uint32_t>& stale) const;
  ShownFrame show(std::uint64_t frame, Pending&& pending);
  void drop(std::map<std::uint64_t, Pending>::iterator pending);
  void release(const Pending& pending);

  ImageSize image_;
  std::vector<bool> owned_;         // by module
  std::vector<std::string> owner_;  // by module: the node its last image came from; empty: none yet
  std::vector<ShownModule> shown_;  // by module
  std::optional<std::uint64_t> last_shown_, latest_swap_;
  std::map<std::string, Node> nodes_;
  std::map<std::uint64_t, Pending> pending_;  // all later than last_shown_
  std::uint64_t dropped_frames_ = 0;
};

}  // namespace lfd::display
