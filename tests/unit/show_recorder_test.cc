// What is recorded of a show that a recorder comes to in the middle, and misses parts of.
#include "cli/show_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/hash.h"
#include "proto/state.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint32_t kPiece = 4;

// A controller of which everything is heard, or not.
struct Played {
  proto::State state;
  std::uint64_t frame = 0;
  std::uint64_t session = 0;
  Clock::time_point now{1s};

  Played() {
    state.set_sequence(5);
    state.mutable_scene()->add_light();
    state.mutable_roi();
    state.mutable_render();
  }

  proto::Envelope envelope() {
    now += 10ms;
    proto::Envelope message;
    message.set_session(session);
    return message;
  }
  proto::Envelope pulse() {
    proto::Envelope message = envelope();
    message.mutable_pulse()->set_sequence(state.sequence());
    return message;
  }
  proto::Envelope update(proto::Update change) {
    change.set_sequence(state.sequence() + 1);
    EXPECT_TRUE(apply_update(state, change));
    proto::Envelope message = envelope();
    *message.mutable_update() = change;
    return message;
  }
  proto::Envelope buffers(std::uint32_t wanted) {
    proto::Update change;
    change.set_buffers(wanted);
    return update(change);
  }
  proto::Envelope begin() {
    proto::Envelope message = envelope();
    message.mutable_begin()->set_frame(frame++);
    message.mutable_begin()->set_sequence(state.sequence());
    return message;
  }
  proto::Envelope swap(std::uint64_t of) {
    proto::Envelope message = envelope();
    message.mutable_swap()->set_frame(of);
    return message;
  }
};

// "snapshot 5", "update 6", "begin 3", "swap 3".
std::vector<std::string> told(ShowRecorder& recorder) {
  std::vector<std::string> lines;
  for (const auto& event : recorder.take_events()) {
    if (event.has_snapshot()) lines.push_back("snapshot " + std::to_string(event.snapshot().sequence()));
    if (event.has_update()) lines.push_back("update " + std::to_string(event.update().sequence()));
    if (event.has_begin()) lines.push_back("begin " + std::to_string(event.begin().frame()));
    if (event.has_swap()) lines.push_back("swap " + std::to_string(event.swap().frame()));
  }
  return lines;
}

struct ShowRecorderTest : testing::Test {
  void hear(const proto::Envelope& message) { recorder.heard(message, show.now); }
  void snapshot() { recorder.snapshot_came(show.state, show.now); }

  Played show;
  ShowRecorder recorder{kPiece};
};

TEST_F(ShowRecorderTest, AsksForASnapshotOnceItsSubscriptionHasArrived) {
  EXPECT_FALSE(recorder.wants_snapshot());
  hear(show.pulse());
  EXPECT_TRUE(recorder.wants_snapshot());
  EXPECT_FALSE(recorder.has_begun());
  snapshot();
  EXPECT_FALSE(recorder.wants_snapshot());
  EXPECT_TRUE(recorder.has_begun());
  EXPECT_THAT(told(recorder), ElementsAre("snapshot 5"));
}

// What was published between the pulse and the snapshot's arrival is in it, or follows it.
TEST_F(ShowRecorderTest, UpdatesThatWaitedFollowTheSnapshot) {
  hear(show.pulse());
  hear(show.begin());  // of state 5, which is gone when the snapshot is made
  hear(show.buffers(1));
  const proto::State at_6 = show.state;
  hear(show.begin());
  hear(show.buffers(2));
  hear(show.begin());
  recorder.snapshot_came(at_6, show.now);
  hear(show.swap(1));
  hear(show.swap(0));
  const auto events = recorder.take_events();
  ASSERT_EQ(events.size(), 5U);
  EXPECT_EQ(events[0].snapshot().sequence(), 6U);
  EXPECT_EQ(events[1].begin().frame(), 1U);
  EXPECT_EQ(events[1].begin().state_hash(), state_hash(at_6));
  EXPECT_EQ(events[2].update().sequence(), 7U);
  EXPECT_EQ(events[3].begin().frame(), 2U);
  EXPECT_EQ(events[3].begin().state_hash(), state_hash(show.state));
  EXPECT_EQ(events[4].swap().frame(), 1U) << "frame 0 was not recorded";
  EXPECT_EQ(recorder.begun_frames(), 2U);
  EXPECT_EQ(recorder.swapped_frames(), 1U);
  EXPECT_EQ(events[1].nanoseconds(), 30'000'000U - 0U) << "as it was heard, since the first message that waited";
}

TEST_F(ShowRecorderTest, LostUpdatesAreMadeUpForByAnotherSnapshot) {
  hear(show.pulse());
  snapshot();
  hear(show.begin());
  show.buffers(1);  // lost
  hear(show.buffers(2));
  hear(show.begin());
  EXPECT_TRUE(recorder.wants_snapshot());
  EXPECT_THAT(told(recorder), ElementsAre("snapshot 5", "begin 0"));
  snapshot();
  hear(show.begin());
  EXPECT_THAT(told(recorder), ElementsAre("snapshot 7", "begin 1", "begin 2"));
  show.buffers(3);  // lost, with nothing after it
  hear(show.pulse());
  EXPECT_TRUE(recorder.wants_snapshot());
  hear(show.begin());
  hear(show.buffers(4));
  snapshot();  // which passes that frame's state over
  EXPECT_THAT(told(recorder), ElementsAre("snapshot 9"));
  EXPECT_EQ(recorder.left_out_frames(), 1U);
}

TEST_F(ShowRecorderTest, WhatWaitsIsBounded) {
  hear(show.pulse());
  for (std::size_t i = 0; i < ShowRecorder::kMostWaiting; ++i) hear(show.buffers(static_cast<std::uint32_t>(i + 1)));
  proto::State old;
  old = show.state;
  old.set_sequence(5);
  hear(show.begin());
  recorder.snapshot_came(old, show.now);
  EXPECT_TRUE(recorder.wants_snapshot()) << "update 6 was forgotten";
  snapshot();
  EXPECT_FALSE(recorder.wants_snapshot());
}

TEST_F(ShowRecorderTest, WhereTheDisplayIsIsNobodysBusiness) {
  hear(show.pulse());
  snapshot();
  proto::Update change;
  change.set_images_endpoint("tcp://10.0.0.1:5000");
  hear(show.update(change));
  const auto events = recorder.take_events();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[1].update().sequence(), 6U);
  EXPECT_FALSE(events[1].update().has_images_endpoint());
}

TEST_F(ShowRecorderTest, EachAssetIsGivenOutOnceAlsoOfLaterScenes) {
  const std::string first = "first mesh", second = "second";
  show.state.mutable_scene()->add_instance()->set_mesh(content_hash(first));
  hear(show.pulse());
  snapshot();
  const auto gather = [&] {
    while (!recorder.gatherer().complete()) {
      for (const proto::Want& want : recorder.gatherer().next_requests(Clock::time_point())) {
        const std::string& content = want.hash() == content_hash(first) ? first : second;
        proto::Chunk chunk;
        chunk.set_hash(want.hash());
        chunk.set_offset(want.offset());
        chunk.set_total(content.size());
        ASSERT_TRUE(recorder.gatherer().piece_came(chunk, content.substr(want.offset(), want.length())));
      }
    }
  };
  gather();
  const auto assets = recorder.take_assets();
  ASSERT_EQ(assets.size(), 1U);
  EXPECT_EQ(*assets[0].content, first);
  EXPECT_THAT(recorder.take_assets(), IsEmpty());
  proto::Update change;
  *change.mutable_scene() = show.state.scene();
  change.mutable_scene()->add_instance()->set_mesh(content_hash(second));
  hear(show.update(change));
  EXPECT_EQ(recorder.missing_assets(), 1U);
  gather();
  const auto more = recorder.take_assets();
  ASSERT_EQ(more.size(), 1U);
  EXPECT_EQ(*more[0].content, second);
  EXPECT_EQ(recorder.missing_assets(), 0U);
}

TEST_F(ShowRecorderTest, EndsWithTheController) {
  hear(show.pulse());
  snapshot();
  proto::Envelope quit;
  quit.mutable_quit()->set_reason("a client asked for it");
  hear(quit);
  ASSERT_TRUE(recorder.end());
  EXPECT_EQ(recorder.end()->reason, "the controller ended: a client asked for it");
  EXPECT_FALSE(recorder.end()->is_fault);
}

TEST_F(ShowRecorderTest, AControllerThatWasStartedAnewIsAnotherShow) {
  show.frame = 7;
  hear(show.pulse());
  snapshot();
  hear(show.begin());
  for (const bool begins : {false, true}) {
    ShowRecorder one = recorder;
    Played anew;
    if (begins) anew.state.set_sequence(show.state.sequence());
    if (!begins) anew.state.set_sequence(2);
    one.heard(begins ? anew.begin() : anew.pulse(), show.now);
    ASSERT_TRUE(one.end()) << begins;
    EXPECT_TRUE(one.end()->is_fault);
    EXPECT_THAT(one.end()->reason, HasSubstr("started anew"));
  }
}

TEST_F(ShowRecorderTest, AnotherSessionIsAnotherShow) {
  show.session = 3;
  hear(show.pulse());
  snapshot();
  show.session = 4;
  hear(show.buffers(1));
  ASSERT_TRUE(recorder.end());
  EXPECT_TRUE(recorder.end()->is_fault);
  EXPECT_THAT(told(recorder), ElementsAre("snapshot 5"));
}

TEST_F(ShowRecorderTest, WhatIsSaidAgainIsNoOtherLife) {
  hear(show.pulse());
  snapshot();
  const auto begin = show.begin();
  hear(begin);
  hear(show.begin());
  auto again = begin;
  again.mutable_begin()->set_again(true);
  hear(again);
  const auto swap = show.swap(0);
  hear(swap);
  again = swap;
  again.mutable_swap()->set_again(true);
  hear(again);
  EXPECT_THAT(told(recorder), ElementsAre("snapshot 5", "begin 0", "begin 1", "swap 0"));
  EXPECT_FALSE(recorder.end());
}

// Of frame 1: another frame is recorded in its place.
TEST_F(ShowRecorderTest, ALostSwapDoesNotKeepItFromHavingEnough) {
  recorder = ShowRecorder(kPiece, 2);
  hear(show.pulse());
  snapshot();
  for (int frame = 0; frame < 2; ++frame) hear(show.begin());
  hear(show.swap(0));
  hear(show.begin());  // not recorded: two are begun
  hear(show.swap(2));
  EXPECT_FALSE(recorder.has_enough());
  hear(show.begin());
  hear(show.swap(3));
  EXPECT_TRUE(recorder.has_enough());
  EXPECT_THAT(told(recorder), ElementsAre("snapshot 5", "begin 0", "begin 1", "swap 0", "begin 3", "swap 3"));
}

TEST_F(ShowRecorderTest, NoMoreFramesAreRecordedThanAskedFor) {
  recorder = ShowRecorder(kPiece, 2);
  hear(show.pulse());
  snapshot();
  for (int frame = 0; frame < 4; ++frame) hear(show.begin());
  EXPECT_FALSE(recorder.has_enough());
  for (std::uint64_t frame = 0; frame < 4; ++frame) hear(show.swap(frame));
  hear(show.buffers(3));
  EXPECT_TRUE(recorder.has_enough());
  EXPECT_THAT(told(recorder), ElementsAre("snapshot 5", "begin 0", "begin 1", "swap 0", "swap 1"));
}

}  // namespace
}  // namespace lfd
