// Bounds what waits for those who asked for the whole state: it is as long as a scene, and stays in memory for as long
// as they do not read it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "proto/wire/payload.h"

namespace lfd::controller {

class Handouts {
 public:
  static constexpr std::size_t kMost_bytes = std::size_t{64} << 20;

  // Whether another one may go out: those that nobody has let go of yet are shorter than kMost_bytes together. The next
  // one may go beyond that, as a single state may.
  bool has_room() {
    std::erase_if(out_, [](const auto& text) { return text.expired(); });
    std::size_t bytes = 0;
    for (const auto& text : out_) {
      if (const auto alive = text.lock()) bytes += alive->size();
    }
    return bytes < kMost_bytes;
  }

  // Counts until the last copy of the payload is gone, the transport's included.
  wire::Payload give(std::string text) {
    auto shared = std::make_shared<const std::string>(std::move(text));
    out_.push_back(shared);
    return wire::Payload(std::move(shared));
  }

 private:
  std::vector<std::weak_ptr<const std::string>> out_;
};

}  // namespace lfd::controller
