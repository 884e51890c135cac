// Decides how many images one node may send, so that what waits of it stays within a bound.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lfd::display {

// The bound, in bytes of payloads: `waiting_bytes`, or one frame of the node's images where that is more (each counted
// as largest_image_bytes, which no payload exceeds). Beside it a node is never more than kFramesPerNode frames ahead.
struct CreditLimits {
  std::size_t waiting_bytes = 0;
  std::size_t largest_image_bytes = 1;
  std::uint32_t modules = 1;  // of the display
};

class NodeCredit {
 public:
  static constexpr std::uint32_t kFramesPerNode = 2;

  // The node has none; what waits stays.
  void start() { given_ = 0; }

  // An image came: it uses up one credit. False where there was none.
  bool use();

  // Whether so many bytes more may wait, of a frame of so many images.
  bool fits(const CreditLimits& limits, std::size_t bytes, std::uint32_t of_images) const;

  // An image waits. pixel_bytes: what the image would have without any encoding.
  void waits(std::size_t bytes, std::size_t pixel_bytes, std::uint32_t of_images);
  void released(std::uint32_t images, std::size_t bytes);
  void clear() { *this = NodeCredit(); }

  bool is_spent() const { return given_ == 0; }

  // So many more images may come; they count as given.
  std::uint32_t give(const CreditLimits& limits);

 private:
  std::uint32_t given_ = 0;  // and not used
  std::uint32_t waiting_ = 0;
  std::size_t waiting_bytes_ = 0;
  std::uint32_t of_images_ = 0;    // of the last frame; 0: not known yet
  std::size_t largest_bytes_ = 0;  // pixels of the largest image so far; 0: not known yet
};

}  // namespace lfd::display
