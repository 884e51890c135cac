// The outbox.
#include "rendernode/node/image_outbox.h"

#include <iterator>

#include "base/check.h"

namespace lfd::node {

void ImageOutbox::push(std::vector<OutgoingImage> images) {
  LFD_CHECK(idle(), "a frame waits already");
  waiting_.assign(std::make_move_iterator(images.begin()), std::make_move_iterator(images.end()));
}

void ImageOutbox::sent() {
  LFD_CHECK(next() != nullptr, "nothing could have been sent");
  waiting_.pop_front();
  --credit_;
}

}  // namespace lfd::node
