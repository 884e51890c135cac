// Who is told what on the images channel.
#include <gtest/gtest.h>

#include <chrono>

#include "display/image_peers.h"
#include "tests/unit/one_pixel_images.h"

namespace lfd::display {
namespace {

using namespace std::chrono_literals;

const Clock::time_point kStart = Clock::time_point{} + 1h;

struct Display {
  FrameAssembly assembly;
  ImagePeers peers{assembly};
  Display() {
    assembly.configure(2, kOnePixel);
    peers.words(kStart);
  }
  // What a peer is told now: -1: nothing; images, + 1000 where it has to begin anew.
  int told(const std::string& peer, Clock::time_point now = kStart) {
    int told = -1;
    for (const auto& words : peers.words(now)) {
      if (words.peer == peer) told = static_cast<int>(words.credit.images()) + (words.credit.anew() ? 1000 : 0);
    }
    return told;
  }
  Status send(const std::string& peer, const proto::Image& image, wire::Payload payload) {
    const auto node = peers.sender(peer);
    if (!node) return Error("a stranger");
    return assembly.image_came(*node, image, std::move(payload), kStart);
  }
};

TEST(ImagePeers, TheFirstCreditAnswersTheHelloAndIsGivenOnce) {
  Display display;
  ASSERT_TRUE(display.peers.hello("1", "left", kStart));
  EXPECT_EQ(display.told("1"), 1002);
  EXPECT_EQ(display.told("1"), -1);
  EXPECT_FALSE(*display.peers.hello("1", "left", kStart)) << "a second hello changes nothing";
  EXPECT_EQ(display.told("1"), -1);
  ASSERT_TRUE(display.send("1", image_of(1, 0, 1), pixel_of(1, 0)));
  EXPECT_EQ(display.told("1"), -1);
  ASSERT_TRUE(display.send("1", image_of(2, 0, 1), pixel_of(2, 0)));
  display.assembly.swapped(1, {});
  display.assembly.swapped(2, {});
  ASSERT_FALSE(display.assembly.next_frame(kStart)) << "module 1 is missing";
}

TEST(ImagePeers, StrangersAreToldToGreet) {
  Display display;
  EXPECT_FALSE(display.send("7", image_of(1, 0, 1), pixel_of(1, 0)));
  EXPECT_FALSE(display.send("7", image_of(1, 1, 1), pixel_of(1, 1)));
  EXPECT_EQ(display.told("7"), 1000);
  EXPECT_EQ(display.told("7"), -1) << "once for all that came";
}

TEST(ImagePeers, ANewConnectionOfANodeTakesThePlaceOfTheOldOne) {
  Display display;
  ASSERT_TRUE(display.peers.hello("1", "left", kStart));
  EXPECT_EQ(display.told("1"), 1002);
  ASSERT_TRUE(*display.peers.hello("2", "left", kStart));
  EXPECT_EQ(display.told("2"), 1002);
  EXPECT_FALSE(display.send("1", image_of(1, 0, 1), pixel_of(1, 0)));
  EXPECT_EQ(display.told("1"), 1000);
  EXPECT_TRUE(display.send("2", image_of(1, 0, 1), pixel_of(1, 0)));
}

TEST(ImagePeers, WhoLostTouchBeginsAnew) {
  Display display;
  ASSERT_TRUE(display.peers.hello("1", "left", kStart));
  EXPECT_EQ(display.told("1"), 1002);
  proto::Image same = image_of(2, 0, 1);
  same.set_same_as_frame(1);
  EXPECT_FALSE(display.send("1", same, {})) << "frame 1 never came";
  EXPECT_EQ(display.told("1"), 1000);
  EXPECT_FALSE(display.send("1", image_of(2, 1, 1), pixel_of(2, 1)));
  ASSERT_TRUE(*display.peers.hello("1", "left", kStart));
  EXPECT_EQ(display.told("1"), 1002);
}

TEST(ImagePeers, ANewDisplayHasNothingOfWhatWasSent) {
  Display display;
  ASSERT_TRUE(display.peers.hello("1", "left", kStart));
  EXPECT_EQ(display.told("1"), 1002);
  ASSERT_TRUE(display.peers.hello("2", "right", kStart));  // has no answer yet
  display.peers.restart(kStart);
  display.assembly.configure(4, kOnePixel);
  EXPECT_EQ(display.told("1"), 1000);
  ASSERT_TRUE(*display.peers.hello("1", "left", kStart));
  EXPECT_EQ(display.told("1"), 1004);
}

TEST(ImagePeers, EmptyCreditsFindOutWhoIsGone) {
  Display display;
  ASSERT_TRUE(display.peers.hello("1", "left", kStart));
  display.told("1");
  EXPECT_EQ(display.told("1", kStart + ImagePeers::kProbePause - 1ms), -1);
  EXPECT_EQ(display.told("1", kStart + ImagePeers::kProbePause), 0);
  EXPECT_EQ(display.peers.gone("1", kStart), "left");
  EXPECT_FALSE(display.peers.gone("1", kStart));
  EXPECT_EQ(display.told("1", kStart + 2 * ImagePeers::kProbePause), -1);
}

TEST(ImagePeers, NamesAreNamesAndNotTooMany) {
  Display display;
  EXPECT_FALSE(display.peers.hello("1", "", kStart));
  EXPECT_FALSE(display.peers.hello("1", std::string(100000, 'x'), kStart));
  std::size_t known = 0;
  for (int i = 0; i < 1000; ++i) known += display.peers.hello(std::to_string(i), std::to_string(i), kStart) ? 1 : 0;
  EXPECT_EQ(known, FrameAssembly::kMaxNodes);
}

}  // namespace
}  // namespace lfd::display
