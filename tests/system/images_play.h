// Both ends that lfd-display has to do with, played by a test: a controller, and a node's outbox with its socket.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "proto/calibration_file.h"
#include "proto/wire/poll.h"
#include "proto/wire/socket.h"
#include "rendernode/node/image_outbox.h"
#include "tests/harness/workbench.h"

namespace lfd::harness::images {

using namespace std::chrono_literals;

inline constexpr auto kPatience = 60s;
inline constexpr ImageSize kSize{128, 96};
inline constexpr std::size_t kImage_bytes = std::size_t{4} * kSize.width * kSize.height;
inline constexpr std::uint32_t kModules = 4;

inline DisplayCalibration four_modules() {
  DisplayCalibration display{"four", {0.4, 0.3}, kSize, {Diffuser::kLinear, 0, 0.8}, 0.1, {}};
  for (const double x : {-0.15, -0.05, 0.05, 0.15}) display.modules.push_back({{x, 0, -0.6}, IdealMap{}});
  return display;
}

// The controller's part.
class Stage {
 public:
  explicit Stage(std::vector<std::string> more) {
    std::vector<std::string> arguments{"--controller", control_.endpoint(), "--log-level", "info"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    display_ = start_program("lfd-display", arguments);
  }

  // Answers the display's join; where it takes images.
  std::string welcome(std::uint32_t waiting_mib = 0, std::uint64_t session = 0) {
    wire::Message join;
    EXPECT_TRUE(hear([&](wire::Message& message) {
      if (message.envelope.has_join()) join = std::move(message);
      return join.envelope.has_join();
    }));
    proto::Envelope envelope;
    envelope.set_session(session);
    auto* welcome = envelope.mutable_welcome();
    welcome->set_state_endpoint(state_.endpoint());
    *welcome->mutable_display() = write_calibration(four_modules());
    welcome->set_heartbeat_ms(2000);
    welcome->mutable_stream()->set_waiting_mib(waiting_mib);
    EXPECT_TRUE(control_.send_to(join.peer, envelope));
    EXPECT_TRUE(hear([](const wire::Message& message) { return message.envelope.has_heartbeat(); }));
    return join.envelope.join().images_endpoint();
  }

  // Hears the display until `wanted` is true of a message.
  template <class Wanted>
  bool hear(Wanted wanted, Clock::duration at_most = kPatience) {
    const auto until = Clock::now() + at_most;
    do {
      while (auto message = control_.receive()) {
        if (wanted(*message)) return true;
      }
      wire::wait({&control_}, {}, 10ms);
    } while (Clock::now() < until);
    return false;
  }

  // What has been shown so far.
  std::uint64_t shown() {
    hear(
        [this](const wire::Message& message) {
          if (message.envelope.has_shown()) shown_ = message.envelope.shown().frame();
          return false;
        },
        0ms);
    return shown_;
  }

  void swap(std::uint64_t frame, std::uint64_t session = 0) {
    proto::Envelope envelope;
    envelope.set_session(session);
    envelope.mutable_swap()->set_frame(frame);
    auto* share = envelope.mutable_swap()->add_share();
    share->set_node("a");
    for (std::uint32_t module = 0; module < kModules; ++module) share->add_module(module);
    EXPECT_TRUE(state_.send(envelope));
  }

  Process& display() { return *display_; }

 private:
  wire::Context context_;
  wire::Socket control_ = *wire::bind_router(context_, "tcp://127.0.0.1:*");
  wire::Socket state_ = *wire::bind_publisher(context_, "tcp://127.0.0.1:*");
  std::unique_ptr<Process> display_;
  std::uint64_t shown_ = 0;
};

// A node's part: its outbox and its socket, as the daemon drives them.
class Sender {
 public:
  explicit Sender(const std::string& endpoint) : socket_(*wire::connect_dealer(context_, endpoint, wire::kImages)) {}

  bool idle() const { return outbox_.idle(); }

  // Every pixel of a frame's image says of which frame and module it is.
  static std::uint8_t value_of(std::uint64_t frame, std::uint32_t module) {
    return static_cast<std::uint8_t>(3 * frame + 50 * module + 1);
  }

  void push(std::uint64_t frame) {
    std::vector<node::OutgoingImage> images(kModules);
    for (std::uint32_t module = 0; module < kModules; ++module) {
      proto::Image& header = images[module].header;
      header.set_frame(frame);
      header.set_module(module);
      header.set_width_px(kSize.width);
      header.set_height_px(kSize.height);
      header.set_of_images(kModules);
      images[module].payload =
          std::make_shared<const std::string>(kImage_bytes, static_cast<char>(value_of(frame, module)));
    }
    outbox_.push(std::move(images));
  }

  // Moves on what can be moved on; waits at most so long where nothing can.
  void step(Clock::duration at_most = 5ms, std::uint64_t session = 0) {
    while (const auto message = socket_.receive()) {
      if (message->envelope.has_credit()) outbox_.credit_came(message->envelope.credit());
    }
    if (outbox_.greets(Clock::now())) {
      proto::Envelope hello;
      hello.mutable_hello()->set_node("a");
      (void)static_cast<bool>(socket_.send(hello));
    }
    while (auto image = outbox_.next()) {
      proto::Envelope envelope;
      envelope.set_session(session);
      *envelope.mutable_image() = std::move(image->header);
      if (!socket_.send(envelope, image->payload)) break;
      outbox_.sent();
      ++sent_;
    }
    wire::wait({&socket_}, {}, at_most);
  }

  // All of the frame has gone to the display, as far as the sender knows.
  bool send_all() {
    const auto until = Clock::now() + kPatience;
    while (!outbox_.idle() && Clock::now() < until) step();
    return outbox_.idle();
  }

  std::uint64_t sent() const { return sent_; }

 private:
  wire::Context context_;
  wire::Socket socket_;
  node::ImageOutbox outbox_;
  std::uint64_t sent_ = 0;
};

}  // namespace lfd::harness::images
