// lfd-display between a played controller and a node's outbox: connections that break, writing that hangs, sessions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <filesystem>
#include <random>
#include <string>

#include "base/clock.h"
#include "base/temporary_folder.h"
#include "proto/frame_files.h"
#include "proto/pictures/png.h"
#include "tests/system/images_play.h"
#include "tests/system/tcp_relay.h"

namespace lfd::harness::images {
namespace {

namespace fs = std::filesystem;

TEST(ImagesChannelProcess, EveryFrameIsShownWhateverBecomesOfTheConnection) {
  const TemporaryFolder folder = *TemporaryFolder::make("lfd-images");
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
  const TemporaryFolder folder = *TemporaryFolder::make("lfd-images");
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
}  // namespace lfd::harness::images
