// The outbox.
#include "rendernode/node/image_outbox.h"

#include "base/check.h"

namespace lfd::node {

const ImageOutbox::Held* ImageOutbox::held(const OutgoingImage& image) const {
  const auto found = held_.find(place_of(image));
  if (image.payload.empty() || found == held_.end()) return nullptr;
  return found->second.payload.bytes().data() == image.payload.bytes().data() ? &found->second : nullptr;
}

ImageOutbox::Load ImageOutbox::push(std::vector<OutgoingImage> images) {
  LFD_CHECK(idle(), "a frame waits already");
  frame_ = std::move(images);
  next_ = 0;
  Load load;
  for (const OutgoingImage& image : frame_) {
    const bool is_held = held(image) != nullptr;
    load.unchanged += is_held ? 1 : 0;
    load.bytes += is_held ? 0 : image.payload.size();
  }
  return load;
}

void ImageOutbox::clear() {
  frame_.clear();
  next_ = 0;
}

void ImageOutbox::credit_came(const proto::Credit& credit) {
  if (!credit.anew()) {
    credit_ += credit.images();
    return;
  }
  credit_ = credit.images();
  held_.clear();
  next_ = 0;
  known_ = credit.images() > 0;
}

void ImageOutbox::reconnected() {
  held_.clear();
  next_ = 0;
  credit_ = 0;
  known_ = false;
  greeted_at_.reset();
}

std::optional<OutgoingImage> ImageOutbox::next() const {
  if (credit_ == 0 || idle()) return std::nullopt;
  OutgoingImage image = frame_[next_];
  if (const Held* same = held(image)) {
    image.header.set_same_as_frame(same->frame);
    image.payload = {};
  }
  return image;
}

void ImageOutbox::sent() {
  LFD_CHECK(credit_ > 0 && !idle(), "nothing could have been sent");
  const OutgoingImage& image = frame_[next_];
  if (!image.payload.empty() && held(image) == nullptr) held_[place_of(image)] = {image.header.frame(), image.payload};
  ++next_;
  --credit_;
}

bool ImageOutbox::greets(Clock::time_point now) {
  const bool is_content = known_ && (credit_ > 0 || idle());
  if (greeted_at_ && now - *greeted_at_ < (is_content ? kContentHelloPause : kHelloPause)) return false;
  greeted_at_ = now;
  return true;
}

}  // namespace lfd::node
