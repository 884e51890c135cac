// Credits count images; the worst that each may bring is counted in bytes.
#include "display/node_credit.h"

#include <algorithm>

namespace lfd::display {

bool NodeCredit::use() {
  if (given_ == 0) return false;
  --given_;
  return true;
}

bool NodeCredit::fits(const CreditLimits& limits, std::size_t bytes, std::uint32_t of_images) const {
  const std::size_t frame = std::size_t{of_images} * limits.largest_image_bytes;
  return waiting_bytes_ + bytes <= std::max(limits.waiting_bytes, frame);
}

void NodeCredit::waits(std::size_t bytes, std::size_t pixel_bytes, std::uint32_t of_images) {
  ++waiting_;
  waiting_bytes_ += bytes;
  of_images_ = of_images;
  largest_bytes_ = std::max(largest_bytes_, pixel_bytes);
}

void NodeCredit::released(std::uint32_t images, std::size_t bytes) {
  waiting_ -= std::min(waiting_, images);
  waiting_bytes_ -= std::min(waiting_bytes_, bytes);
}

std::uint32_t NodeCredit::give(const CreditLimits& limits) {
  const std::size_t largest =
      std::max<std::size_t>(largest_bytes_ > 0 ? largest_bytes_ : limits.largest_image_bytes, 1);
  const std::size_t used = std::size_t{given_} + waiting_;
  const auto up_to = [&](std::size_t images) { return images > used ? images - used : 0; };
  std::size_t frame = of_images_, ahead = std::size_t{kFramesPerNode} * of_images_;
  if (of_images_ == 0) {
    ahead = std::max(limits.modules, 1u);
    frame = std::clamp<std::size_t>(limits.waiting_bytes / largest, 1, ahead);
  }
  const std::size_t taken = waiting_bytes_ + given_ * largest;
  const std::size_t room = limits.waiting_bytes > taken ? (limits.waiting_bytes - taken) / largest : 0;
  const auto more = static_cast<std::uint32_t>(std::max(up_to(frame), std::min(room, up_to(ahead))));
  given_ += more;
  return more;
}

}  // namespace lfd::display
