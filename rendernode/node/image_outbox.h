// Decides which images may be sent now: by the display's credits, whole frames in order, at most one frame waiting.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "proto/wire.pb.h"
#include "proto/wire/payload.h"

namespace lfd::node {

struct OutgoingImage {
  proto::Image header;
  wire::Payload payload;
};

class ImageOutbox {
 public:
  // Whether the images of another frame can be taken: those of the last one have all gone.
  bool idle() const { return waiting_.empty(); }

  // Takes a frame's images; only while idle.
  void push(std::vector<OutgoingImage> images);

  void credit(std::uint32_t images) { credit_ += images; }

  // A display has (again) to be greeted: old credits count no more; what waits stays.
  void reconnected() { credit_ = 0; }

  // The next image, if one waits and there is credit for it; sent() once it has gone.
  const OutgoingImage* next() const { return credit_ > 0 && !waiting_.empty() ? &waiting_.front() : nullptr; }
  void sent();

 private:
  std::deque<OutgoingImage> waiting_;
  std::uint64_t credit_ = 0;
};

}  // namespace lfd::node
