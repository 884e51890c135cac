// The sink `files`: a thread that writes the node's own images.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/failure_news.h"
#include "base/result.h"
#include "proto/wire/mailbox.h"
#include "rendernode/node/image_outbox.h"

namespace lfd::node {

class FileSink {
 public:
  explicit FileSink(std::filesystem::path folder) : folder_(std::move(folder)), worker_([this] { work(); }) {}
  // What has been taken is still written, for at most half a second and one more picture: the node has to end.
  ~FileSink();

  // Takes a frame's images; false where two frames wait already.
  bool put(std::vector<OutgoingImage> images) { return frames_.put(std::move(images)); }

 private:
  void work();
  void note(const Status& written);

  std::filesystem::path folder_;
  wire::Mailbox<std::vector<OutgoingImage>> frames_{2};
  FailureNews news_;
  std::atomic<Clock::time_point> give_up_at_{Clock::time_point::max()};
  std::jthread worker_;
};

}  // namespace lfd::node
