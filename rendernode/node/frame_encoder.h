// Puts the images of frames into the form in which they travel, on threads of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "proto/images/image_payload.h"
#include "proto/wire/mailbox.h"
#include "rendernode/node/image_outbox.h"

namespace lfd::node {

// One frame is in hand at a time; its images are spread over the threads. Where an image is what the last one of its
// module and buffer was (the same bytes in memory, or equal ones), it gets the very payload of that one, so that
// nothing is encoded twice and an ImageOutbox sees that nothing changed. One thread uses it.
class FrameEncoder {
 public:
  FrameEncoder();
  // Gives up what is in hand; waits at most for one JPEG, or one step of zstd.
  ~FrameEncoder();
  FrameEncoder(const FrameEncoder&) = delete;
  FrameEncoder& operator=(const FrameEncoder&) = delete;

  bool idle() const { return job_ == nullptr; }

  // Takes a frame's images, payloads: pixels; only while idle.
  void put(const proto::Stream& stream, std::vector<OutgoingImage> images);

  // The frame in hand, once it is encoded.
  std::optional<std::vector<OutgoingImage>> take();
  // Readable while take() has something.
  int descriptor() const { return done_.descriptor(); }

  // Gives up the frame in hand, if there is one, and forgets the ones before.
  void give_up();

 private:
  struct Last {
    std::weak_ptr<const void> pixels;  // in memory, as they came
    std::string hash;                  // of them; empty: none yet
    proto::Encoding encoding = proto::RAW;
    wire::Payload payload;
  };
  struct Job {
    proto::Stream stream;
    std::vector<OutgoingImage> images;
    std::atomic<std::size_t> left{0};
    std::atomic<bool> gives_up{false};
  };
  struct Task {
    std::shared_ptr<Job> job;
    OutgoingImage* image = nullptr;  // of the job
    std::shared_ptr<Last> last;      // image of this module and buffer
  };

  void work();
  void hand_back(std::shared_ptr<Job> job);
  static void encode(PayloadEncoder& encoder, const Job& job, OutgoingImage& image, Last& last);

  std::shared_ptr<Job> job_;
  proto::Stream stream_;  // of last_
  std::map<std::pair<std::uint32_t, proto::BufferKind>, std::shared_ptr<Last>> last_;
  wire::Mailbox<Task> tasks_;
  wire::Mailbox<std::shared_ptr<Job>> done_;
  std::atomic<bool> ends_{false};
  std::vector<std::jthread> workers_;
};

}  // namespace lfd::node
