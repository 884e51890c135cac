// The images channel as the daemons use it: outbox, envelopes, credits, assembly.
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "bench/stream/throughput.h"
#include "bench/stream/two_processes.h"
#include "display/daemon.h"
#include "display/frame_assembly.h"
#include "display/image_peers.h"
#include "proto/key_files.h"
#include "proto/wire/curve.h"
#include "proto/wire/poll.h"
#include "proto/wire/socket.h"
#include "rendernode/node/image_outbox.h"

namespace lfd::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kModules = 16;
constexpr auto kTick = 20ms;
constexpr auto kPatience = 30s;
constexpr int kWidth_px = 1024;

ImageSize size_of(std::size_t image_bytes) {
  return {kWidth_px, static_cast<int>(image_bytes / (std::size_t{4} * kWidth_px))};
}

struct Keys {
  KeyRing display, node;
};

Result<Keys> make_keys() {
  LFD_TRY(const proto::KeyFile display, wire::make_key("display"));
  LFD_TRY(const proto::KeyFile node, wire::make_key("node"));
  const AllowList allowed{{{"display", display.public_key(), {proto::Allowed::DISPLAY}},
                           {"node", node.public_key(), {proto::Allowed::NODE}}}};
  return Keys{{display, allowed}, {node, allowed}};
}

std::unique_ptr<wire::Context> context_of(const std::optional<Keys>& keys, KeyRing Keys::*whose) {
  return keys ? std::make_unique<wire::Context>((*keys).*whose) : std::make_unique<wire::Context>();
}

// Frames of which every image differs from the one before.
class Frames {
 public:
  explicit Frames(std::size_t image_bytes) : size_(size_of(image_bytes)) {
    for (auto& set : pixels_) {
      for (auto& payload : set) payload = std::make_shared<const std::string>(image_bytes, 'x');
    }
  }

  std::vector<node::OutgoingImage> make(std::uint64_t frame) const {
    std::vector<node::OutgoingImage> images(kModules);
    for (std::uint32_t module = 0; module < kModules; ++module) {
      proto::Image& header = images[module].header;
      header.set_frame(frame);
      header.set_module(module);
      header.set_width_px(static_cast<std::uint32_t>(size_.width));
      header.set_height_px(static_cast<std::uint32_t>(size_.height));
      header.set_of_images(kModules);
      images[module].payload = pixels_[frame % 2][module];
    }
    return images;
  }

 private:
  ImageSize size_;
  std::array<std::array<wire::Payload, kModules>, 2> pixels_;
};

// As rendernode/node/daemon_frames.cc, for ever.
void send_all(const std::string& endpoint, std::size_t image_bytes, const std::optional<Keys>& keys) {
  const Frames frames(image_bytes);
  const auto context = context_of(keys, &Keys::node);
  auto socket = wire::connect_dealer(*context, endpoint, wire::kImages, wire::Listener::kDisplay);
  if (!socket) return;
  node::ImageOutbox outbox;
  for (std::uint64_t frame = 0;;) {
    while (const auto message = socket->receive()) outbox.credit_came(message->envelope.credit());
    if (outbox.greets(Clock::now())) {
      proto::Envelope hello;
      hello.mutable_hello()->set_node("node");
      static_cast<void>(static_cast<bool>(socket->send(hello)));
    }
    while (true) {
      if (outbox.idle()) outbox.push(frames.make(++frame));
      auto image = outbox.next();
      if (!image) break;
      proto::Envelope envelope;
      *envelope.mutable_image() = std::move(image->header);
      if (!socket->send(envelope, image->payload)) break;
      outbox.sent();
    }
    wire::wait({&*socket}, {}, kTick);
  }
}

// As display/daemon.cc, without files.
class Receiver {
 public:
  Receiver(wire::Socket socket, std::size_t image_bytes, int images)
      : socket_(std::move(socket)), images_(images), warm_up_(warm_up_of(images)) {
    assembly_.configure(kModules, size_of(image_bytes));
  }

  Result<double> seconds() {
    const auto give_up_at = Clock::now() + kPatience;
    while (received_ < images_) {
      if (Clock::now() > give_up_at) return Error("no more images come");
      wire::wait({&socket_}, {}, kTick);
      for (int i = 0; i < display::kImagesPerPass; ++i) {
        auto message = socket_.receive();
        if (!message) break;
        LFD_TRY_STATUS(hear(std::move(*message)));
      }
      while (assembly_.next_frame(Clock::now())) {
      }
      for (const auto& [peer, credit] : peers_.words(Clock::now())) {
        proto::Envelope envelope;
        *envelope.mutable_credit() = credit;
        LFD_TRY_STATUS(socket_.send_to(peer, envelope));
      }
    }
    return milliseconds(last_ - first_) / 1000;
  }

 private:
  Status hear(wire::Message&& message) {
    const auto now = Clock::now();
    if (message.envelope.has_hello()) {
      const auto known = peers_.hello(message.peer, message.envelope.hello().node(), now);
      return known ? Status() : known.error();
    }
    const auto sender = peers_.sender(message.peer);
    if (!sender) return {};
    const proto::Image& image = message.envelope.image();
    LFD_TRY_STATUS(assembly_.image_came(*sender, image, std::move(message.payload), now));
    if (image.frame() != swapped_) assembly_.swapped(swapped_ = image.frame(), {});
    if (++received_ == warm_up_) first_ = now;
    last_ = now;
    return {};
  }

  wire::Socket socket_;
  display::FrameAssembly assembly_;
  display::ImagePeers peers_{assembly_};
  Clock::time_point first_{}, last_{};
  std::uint64_t swapped_ = 0;
  int images_, warm_up_, received_ = 0;
};

}  // namespace

Result<double> images_pair_seconds(std::size_t image_bytes, int images, bool keyed) {
  std::optional<Keys> keys;
  if (keyed) {
    LFD_TRY(keys, make_keys());
  }
  return between_two_processes(
      [&](const auto& say) -> Result<double> {
        const auto context = context_of(keys, &Keys::display);
        LFD_TRY(wire::Socket socket,
                wire::bind_router(*context, "tcp://127.0.0.1:*", display::image_limits(size_of(image_bytes)),
                                  wire::Listener::kDisplay));
        say(socket.endpoint());
        return Receiver(std::move(socket), image_bytes, images).seconds();
      },
      [&](const std::string& endpoint) { send_all(endpoint, image_bytes, keys); });
}

}  // namespace lfd::bench
