// lfd-display between a played controller and a node's outbox: connections that break, writing that hangs, sessions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "proto/calibration_file.h"
#include "proto/frame_files.h"
#include "proto/pictures/png.h"
#include "proto/wire/poll.h"
#include "proto/wire/socket.h"
#include "rendernode/node/frame_encoder.h"
#include "rendernode/node/image_outbox.h"
#include "tests/harness/workbench.h"
#include "tests/system/tcp_relay.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr auto kPatience = 60s;
constexpr ImageSize kSize{128, 96};
constexpr std::size_t kImage_bytes = std::size_t{4} * kSize.width * kSize.height;
constexpr std::uint32_t kModules = 4;

DisplayCalibration four_modules() {
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

TEST(ImagesChannelProcess, EveryFrameIsShownWhateverBecomesOfTheConnection) {
  const TemporaryFolder folder("lfd-images");
  Stage stage({"--out", folder.path().string()});
  TcpRelay relay(stage.welcome());
  Sender sender(relay.endpoint());
  std::mt19937 random(5);
  constexpr std::uint64_t kFrames = 40;
  for (std::uint64_t frame = 1; frame <= kFrames; ++frame) {
    sender.push(frame);
    stage.swap(frame);
    const bool breaks = frame % 3 == 0 && frame < kFrames;
    const int breaks_after = static_cast<int>(random() % 4);
    const auto until = Clock::now() + kPatience;
    // The next one is sent once this one is shown: nothing is lost to later frames.
    for (int step = 0; stage.shown() < frame && Clock::now() < until; ++step) {
      sender.step(1ms);
      if (breaks && step == breaks_after) relay.cut();
    }
    ASSERT_EQ(stage.shown(), frame) << testing::PrintToString(stage.display().lines());
  }
  EXPECT_GE(relay.cuts(), 5);
  for (std::uint32_t module = 0; module < kModules; ++module) {
    const auto picture = read_png(image_path(folder.path(), kFrames, module, proto::COLOR));
    ASSERT_TRUE(picture) << picture.error().message();
    EXPECT_EQ(picture->rgba[0], Sender::value_of(kFrames, module));
  }
}

TEST(ImagesChannelProcess, ADisplayWhoseWritingHangsCostsFramesAndNeverMemory) {
  const TemporaryFolder folder("lfd-images");
  // Pipes that nobody reads from: whoever opens them to write waits for ever.
  for (const std::uint64_t frame : {1, 2}) {
    fs::create_directories(frame_path(folder.path(), frame));
    for (std::uint32_t module = 0; module < kModules; ++module) {
      const auto path = image_path(folder.path(), frame, module, proto::COLOR);
      ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    }
  }
  Stage stage({"--out", folder.path().string()});
  constexpr std::uint32_t kWaiting_mib = 1;
  Sender sender(stage.welcome(kWaiting_mib));
  // With a deadline a node drops a frame where the one before has not gone.
  std::uint64_t dropped = 0;
  const auto before = resident_bytes(stage.display().id());
  for (std::uint64_t frame = 1; frame <= 600; ++frame) {
    sender.step(0ms);
    if (sender.idle()) {
      sender.push(frame);
      stage.swap(frame);
    } else {
      ++dropped;
      if (dropped % 50 == 0) sender.step(20ms);
    }
  }
  for (int i = 0; i < 20; ++i) sender.step(20ms);
  // Each frame would have brought 192 KiB. One is shown, two are being written, the last ones are kept; the rest waits.
  const std::uint64_t bound = (std::uint64_t{kWaiting_mib} << 20) + 4 * kModules * kImage_bytes;
  EXPECT_LE(sender.sent() * kImage_bytes, bound);
  EXPECT_GT(dropped, 500u);
  EXPECT_LT(resident_bytes(stage.display().id()), before + bound + (16u << 20));
  EXPECT_EQ(stage.shown(), 0u);
  // It hears all the same, and its end does not wait for the disk.
  EXPECT_TRUE(stage.hear([](const wire::Message& message) { return message.envelope.has_heartbeat(); }));
  stage.display().signal(SIGTERM);
  const auto exit = stage.display().wait(2s);
  ASSERT_TRUE(exit);
  EXPECT_TRUE(exit->succeeded()) << exit->text();
}

TEST(ImagesChannelProcess, AStoppedDisplayIsWaitedForAndNothingIsLost) {
  Stage stage({});
  Sender sender(stage.welcome(1));
  sender.push(1);
  stage.swap(1);
  ASSERT_TRUE(sender.send_all());
  while (stage.shown() < 1) sender.step();
  stage.display().signal(SIGSTOP);
  std::uint64_t frame = 1;
  const auto before = resident_bytes(::getpid());
  // Without a deadline a node waits with the next frame until this one has gone.
  for (int steps = 0; steps < 200; ++steps) {
    if (sender.idle()) {
      sender.push(++frame);
      stage.swap(frame);
    }
    sender.step(2ms);
  }
  EXPECT_FALSE(sender.idle());
  EXPECT_LE(frame, 8u) << "1 MiB of credits, and a frame that waits";
  EXPECT_LT(resident_bytes(::getpid()), before + (16u << 20));
  stage.display().signal(SIGCONT);
  while (frame < 20) {
    ASSERT_TRUE(sender.send_all());
    sender.push(++frame);
    stage.swap(frame);
  }
  const auto until = Clock::now() + kPatience;
  std::uint64_t seen = 1;
  while (seen < frame && Clock::now() < until) {
    sender.step();
    stage.hear(
        [&](const wire::Message& message) {
          if (!message.envelope.has_shown()) return false;
          EXPECT_EQ(message.envelope.shown().frame(), ++seen) << "none is left out";
          return false;
        },
        0ms);
  }
  EXPECT_EQ(seen, frame);
}

TEST(ImagesChannelProcess, WhatIsOfAnotherSessionIsPassedOver) {
  Stage stage({});
  Sender sender(stage.welcome(0, 7));
  sender.push(5);
  stage.swap(5, 6);
  const auto until = Clock::now() + kPatience;
  while (!sender.idle() && Clock::now() < until) sender.step(5ms, 6);
  sender.push(1);
  stage.swap(1, 7);
  while (stage.shown() < 1 && Clock::now() < until) sender.step(5ms, 7);
  EXPECT_EQ(stage.shown(), 1u) << "frame 5 belongs to another controller's life";
  const auto lines = stage.display().lines();
  EXPECT_THAT(lines, testing::Not(testing::Contains(testing::HasSubstr("refused")))) << "nothing to worry about";
}

}  // namespace
}  // namespace lfd::harness
