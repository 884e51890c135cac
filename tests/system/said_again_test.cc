// Frames without a deadline are waited for: what the controller, a node or the display said of one and the other did
// not hear is said again, and a client that asked for frames always has its answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/control_client.h"
#include "tests/harness/played_node.h"
#include "tests/support/unwrapped.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing::Each;
using testing::HasSubstr;
using testing::SizeIs;
using testing_support::unwrapped;

class SaidAgain : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(plays_until([&] { return left_.holds_state() && right_.holds_state() && display_.welcome; }));
  }

  void ask_for_frames(std::uint32_t count) {
    proto::Request request;
    request.mutable_frames()->set_count(count);
    const auto sent = client_.send(request, kClusterPatience);
    ASSERT_TRUE(sent);
    id_ = *sent;
  }

  bool is_answered() {
    if (!reply_) reply_ = client_.receive(id_, 0s);
    return reply_.has_value();
  }

  bool plays_until(const std::function<bool()>& done) { return play_until({&left_, &right_, &display_}, done); }

  const Workbench bench_;
  const RunningController controller_ = start_controller(bench_.deployment("pacing { heartbeat_ms: 200 }"), {"--idle"});
  PlayedNode left_{"left", controller_.endpoint}, right_{"right", controller_.endpoint};
  PlayedNode display_{"display",
                      controller_.endpoint,
                      {.role = proto::DISPLAY, .images_endpoint = "tcp://127.0.0.1:9", .process = 2, .shows = true}};
  ControlClient client_ = unwrapped(ControlClient::connect(controller_.endpoint));
  std::uint64_t id_ = 0;
  std::optional<proto::Reply> reply_;
};

TEST_F(SaidAgain, ABeginToWhoHasNotAnsweredIt) {
  right_.habits.draws = false;  // as if it had not come
  ask_for_frames(1);
  ASSERT_TRUE(plays_until([&] { return right_.named.size() >= 4; }));
  EXPECT_THAT(right_.named, Each(right_.named[0]));
  const std::size_t named_left = left_.named.size(), named_right = right_.named.size();
  ASSERT_TRUE(plays_until([&] { return right_.named.size() >= named_right + 3; }));
  EXPECT_THAT(left_.named, SizeIs(named_left)) << "it has answered";
  EXPECT_FALSE(is_answered());
  right_.habits.draws = true;
  ASSERT_TRUE(plays_until([&] { return is_answered(); }));
  EXPECT_EQ(reply_->error(), "");
  EXPECT_THAT(reply_->frame(), SizeIs(1));
}

TEST_F(SaidAgain, ASwapToADisplayThatHasNotAnsweredIt) {
  display_.habits.shows = false;
  ask_for_frames(2);
  ASSERT_TRUE(plays_until([&] { return display_.swaps.size() >= 6; }));
  EXPECT_FALSE(is_answered());
  display_.habits.shows = true;
  ASSERT_TRUE(plays_until([&] { return is_answered(); }));
  EXPECT_EQ(reply_->error(), "");
  EXPECT_THAT(reply_->frame(), SizeIs(2));
}

TEST_F(SaidAgain, AFrameThatTheDisplayDroppedIsAnError) {
  display_.habits.drops = true;
  ask_for_frames(2);
  ASSERT_TRUE(plays_until([&] { return is_answered(); }));
  EXPECT_THAT(reply_->error(), HasSubstr("was not shown: images of it were lost"));
}

TEST_F(SaidAgain, AFrameThatTheDisplayOfBeforeHasNotShownIsAnError) {
  display_.habits.shows = false;
  ask_for_frames(1);
  ASSERT_TRUE(plays_until([&] { return display_.swaps.size() >= 2; }));
  display_.habits.beats = false;
  ASSERT_TRUE(plays_until([&] { return is_answered(); }));
  EXPECT_THAT(reply_->error(), HasSubstr("the display is out, and has not shown every frame"));
}

// Before the frame is swapped.
TEST_F(SaidAgain, AFrameWithoutADisplayIsAnError) {
  right_.habits.draws = false;
  ask_for_frames(1);
  ASSERT_TRUE(plays_until([&] { return !right_.named.empty(); }));
  display_.habits.beats = false;
  display_.leave();
  right_.habits.draws = true;
  ASSERT_TRUE(plays_until([&] { return is_answered(); }));
  EXPECT_THAT(reply_->error(), HasSubstr("the display is out"));
}

// A frame never mixes two states, whatever a node believes to draw.
TEST_F(SaidAgain, AFrameOfAnotherStateCountsAsNotDrawn) {
  right_.habits.drawn_hash = "another";
  ask_for_frames(1);
  ASSERT_TRUE(plays_until([&] { return is_answered() && !display_.swaps.empty(); }));
  EXPECT_THAT(reply_->error(), HasSubstr("node \"right\": frame 0: it drew another state"));
  EXPECT_THAT(display_.swaps.back().stale_modules(), testing::ElementsAre(2, 3));
}

}  // namespace
}  // namespace lfd::harness
