// The replay: which change precedes which frame, when it is due, and what of a recording cannot be replayed.
#include "controller/replay/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "controller/frame_log.h"
#include "controller/stage.h"
#include "proto/settings.h"
#include "tests/support/made.h"
#include "tests/support/recorded_show.h"

namespace lfd::controller {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing_support::made_data;
using testing_support::read_recording;
using testing_support::RecordedShow;
using testing_support::unwrapped;
using testing_support::whole_state;

DisplayCalibration display(const std::string& name = "one") {
  DisplayCalibration display;
  display.name = name;
  display.screen = {1.6, 0.9};
  display.image = {16, 8};
  display.optics.diffuser = Diffuser::kLinear;
  display.angular_scattering_rad = 0.4;
  display.modules.push_back({Emitter{0, 0, -1}, IdealMap{}});
  return display;
}

proto::State state_of(const SceneData& data) {
  return whole_state(data, write_roi(testing_support::whole_scene(data.scene, display())));
}

proto::Update update_with(std::uint32_t buffers) {
  proto::Update update;
  update.set_buffers(buffers);
  return update;
}

// Frames 4 (buffers 0), 5 (1), 6 (2) and 9 (2), each 40 ms after the one before but the last.
RecordedShow small_show() {
  RecordedShow show(display());
  const SceneData data = made_data("plane");
  show.snapshot(state_of(data));
  show.assets(data.assets);
  show.frame(4);
  show.update(update_with(7));
  show.update(update_with(1));
  show.frame(5);
  show.update(update_with(2));
  show.now_ns += 10'000'000;
  show.frame(6);
  show.frame(9);
  show.end();
  return show;
}

Result<Replay> replay_of(const RecordedShow& show, const Replay::Options& options = {}) {
  return Replay::of(unwrapped(read_recording(show.bytes)), display(), options);
}

// All frames, as they come one after the other.
std::vector<std::uint64_t> frames_of(Replay& replay) {
  std::vector<std::uint64_t> frames;
  while (const Replay::Cue* cue = replay.next()) {
    frames.push_back(cue->frame);
    EXPECT_TRUE(replay.begun(Clock::time_point()));
  }
  return frames;
}

Deployment deployment() {
  Deployment deployment;
  deployment.display = display();
  deployment.animation_frames_per_second = 60;
  return deployment;
}

TEST(Replay, EachFrameComesWithAllThatChangedBeforeIt) {
  Replay replay = unwrapped(replay_of(small_show()));
  Stage stage = unwrapped(Stage::of(deployment()));
  const std::vector<std::pair<std::uint64_t, std::uint32_t>> expected{{4, 0}, {5, 1}, {6, 2}, {9, 2}};
  for (const auto& [frame, buffers] : expected) {
    ASSERT_NE(replay.next(), nullptr);
    EXPECT_EQ(replay.next()->frame, frame);
    const std::string hash = replay.next()->state_hash;
    if (auto change = replay.take_change()) {
      ASSERT_TRUE(stage.show_recorded(std::move(change->update), std::move(change->assets)));
    }
    EXPECT_FALSE(replay.take_change()) << "it is made once";
    EXPECT_EQ(stage.store().state().buffers(), buffers);
    EXPECT_EQ(stage.store().hash(), hash);
    ASSERT_TRUE(replay.begun(Clock::time_point()));
    EXPECT_TRUE(replay.drawn(frame, "left", hash));
  }
  EXPECT_EQ(replay.next(), nullptr);
  EXPECT_EQ(replay.last_frame(), 9U);
  EXPECT_EQ(stage.assets().size(), made_data("plane").assets.size());
  EXPECT_EQ(replay.summary(), "4 frames replayed; each of 4 node's pictures was of the recorded state");
}

// Updates between two frames come as one, which names what one of them moved.
TEST(Replay, WhatMovedComesByItself) {
  RecordedShow show(display());
  SceneData data = made_data("corner");
  ASSERT_GE(data.scene.light_size(), 2);
  for (int i = 0; i < 20; ++i) *data.scene.add_instance() = data.scene.instance(0);
  show.snapshot(state_of(data));
  show.assets(data.assets);
  show.frame(1);
  for (const auto& [index, x] : {std::pair{7U, 1.0}, {3U, 2.0}, {7U, 3.0}}) {
    proto::Update update;
    proto::MovedInstance& moved = *update.add_moved_instance();
    moved.set_index(index);
    *moved.mutable_world_from_mesh() = data.scene.instance(0).world_from_mesh();
    moved.set_world_from_mesh(3, x);
    update.add_moved_light()->set_index(1);
    *update.mutable_moved_light(0)->mutable_light() = data.scene.light(0);
    show.update(update);
  }
  show.frame(2);
  show.frame(3);
  Replay replay = unwrapped(replay_of(show));
  Stage stage = unwrapped(Stage::of(deployment()));
  std::vector<proto::Update> changes;
  while (replay.next() != nullptr) {
    if (auto change = replay.take_change()) {
      const auto shown = stage.show_recorded(std::move(change->update), std::move(change->assets));
      ASSERT_TRUE(shown) << shown.error().message();
      changes.push_back(*shown);
    }
    EXPECT_EQ(stage.store().hash(), replay.next()->state_hash);
    ASSERT_TRUE(replay.begun(Clock::time_point()));
  }
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_FALSE(changes[1].has_scene());
  ASSERT_EQ(changes[1].moved_instance_size(), 2);
  EXPECT_EQ(changes[1].moved_instance(0).index(), 3U);
  EXPECT_EQ(changes[1].moved_instance(1).world_from_mesh(3), 3.0);
  EXPECT_EQ(changes[1].moved_light_size(), 1);
}

TEST(Replay, FramesAreDueAtTheRecordedPaceTimesTheSpeed) {
  for (const double speed : {1.0, 2.0}) {
    Replay replay = unwrapped(replay_of(small_show(), {.speed = speed}));
    const Clock::time_point start{100s};
    EXPECT_TRUE(replay.due(start)) << "the first one as soon as it can";
    ASSERT_TRUE(replay.begun(start));
    const auto second = start + std::chrono::duration_cast<Clock::duration>(40ms / speed);
    EXPECT_EQ(replay.due_at(), second);
    EXPECT_FALSE(replay.due(second - 1ns));
    EXPECT_TRUE(replay.due(second));
    ASSERT_TRUE(replay.begun(second + 1s)) << "late";
    EXPECT_EQ(replay.due_at(), start + std::chrono::duration_cast<Clock::duration>(80ms / speed))
        << "the others keep their times";
  }
  Replay fast = unwrapped(replay_of(small_show(), {.speed = 0}));
  EXPECT_TRUE(fast.waits_for_every_node());
  ASSERT_TRUE(fast.begun(Clock::time_point()));
  EXPECT_FALSE(fast.due_at());
  EXPECT_TRUE(fast.due(Clock::time_point()));
}

TEST(Replay, SomeFramesAloneBeginWithTheirWholeState) {
  Replay replay = unwrapped(replay_of(small_show(), {.frames = FrameRange{5, 6}}));
  Stage stage = unwrapped(Stage::of(deployment()));
  auto change = replay.take_change();
  ASSERT_TRUE(change);
  ASSERT_TRUE(stage.show_recorded(std::move(change->update), std::move(change->assets)));
  EXPECT_EQ(stage.store().hash(), replay.next()->state_hash);
  EXPECT_THAT(frames_of(replay), ElementsAre(5, 6));
  const auto none = replay_of(small_show(), {.frames = FrameRange{7, 8}});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message(), "it has frames 4 to 9; none of them is asked for");
}

TEST(Replay, AnotherDisplayIsRefusedByNameUnlessItIsAskedFor) {
  const auto refused = Replay::of(unwrapped(read_recording(small_show().bytes)), display("other"), {});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("it was recorded on display \"one\""));
  EXPECT_THAT(refused.error().message(), HasSubstr("is to be shown on \"other\""));
  EXPECT_TRUE(Replay::of(unwrapped(read_recording(small_show().bytes)), display("other"), {.any_display = true}));
}

TEST(Replay, AStateOfAnotherHashIsAnErrorWithItsPlace) {
  RecordedShow show = small_show();
  show = RecordedShow(display());
  const SceneData data = made_data("plane");
  show.snapshot(state_of(data));
  show.assets(data.assets);
  show.frame(4);
  const std::size_t offset = show.bytes.size();
  proto::RecordingRecord record;
  record.mutable_event()->set_nanoseconds(show.now_ns);
  record.mutable_event()->mutable_begin()->set_frame(5);
  record.mutable_event()->mutable_begin()->set_state_hash("forged");
  show.add(record);
  Replay replay = unwrapped(replay_of(show));
  const Status begun = replay.begun(Clock::time_point());
  ASSERT_FALSE(begun);
  EXPECT_EQ(begun.error().message(), "offset " + std::to_string(offset) + ": frame 5: its state has hash " +
                                         state_hash(show.state) + "; forged was recorded");
  EXPECT_EQ(replay.next(), nullptr);
}

TEST(Replay, UpdatesThatDoNotFitAreErrors) {
  RecordedShow show(display());
  show.snapshot(state_of(made_data("plane")));
  proto::RecordingRecord record;
  record.mutable_event()->set_nanoseconds(show.now_ns);
  record.mutable_event()->mutable_update()->set_sequence(3);
  show.add(record);
  EXPECT_THAT(replay_of(show).error().message(), HasSubstr("update 3 does not follow state 1"));
  RecordedShow light(display());
  proto::State state = state_of(made_data("plane"));
  state.mutable_scene()->add_light()->add_color(-1);
  light.snapshot(state);
  EXPECT_THAT(replay_of(light).error().message(), HasSubstr("color: -1"));
  RecordedShow dark(display());
  dark.snapshot(state_of(made_data("plane")));
  proto::Update update;
  update.add_moved_light()->set_index(1);
  update.mutable_moved_light(0)->mutable_light()->add_color(-1);
  dark.update(update);
  EXPECT_THAT(replay_of(dark).error().message(), HasSubstr("light 1: color: -1"));
  RecordedShow halves(display());
  halves.snapshot(proto::State());
  EXPECT_THAT(replay_of(halves).error().message(), HasSubstr("a state that is not whole"));
}

// The controller showed another scene before the recorder had all of the first.
TEST(Replay, FramesOfAnIncompleteSceneAreLeftOut) {
  RecordedShow show(display());
  const SceneData plane = made_data("plane"), room = made_data("room");
  show.snapshot(state_of(plane));
  show.frame(1);
  proto::Update scene;
  *scene.mutable_scene() = room.scene;
  show.update(scene);
  show.frame(2);
  show.assets(room.assets);
  Replay replay = unwrapped(replay_of(show));
  Stage stage = unwrapped(Stage::of(deployment()));
  auto change = replay.take_change();
  ASSERT_TRUE(change);
  ASSERT_TRUE(stage.show_recorded(std::move(change->update), std::move(change->assets)));
  EXPECT_EQ(stage.store().hash(), replay.next()->state_hash);
  EXPECT_THAT(frames_of(replay), ElementsAre(2));
  EXPECT_THAT(replay.summary(), HasSubstr("1 frame left out: scenes were not recorded whole"));
}

TEST(Replay, ANodeThatDrewAnotherStateIsNamed) {
  Replay replay = unwrapped(replay_of(small_show()));
  ASSERT_TRUE(replay.begun(Clock::time_point()));
  const Status other = replay.drawn(4, "left", "other");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message(), HasSubstr("frame 4: node \"left\" drew state other"));
  EXPECT_THAT(replay.summary(), HasSubstr("1 of 1 node's picture were not of the recorded state"));
}

TEST(StageShowRecorded, RefusesWhatThisDisplayCannotShow) {
  Stage stage = unwrapped(Stage::of(deployment()));
  Replay replay = unwrapped(replay_of(small_show()));
  auto change = replay.take_change();
  ASSERT_TRUE(change);
  change->update.mutable_render()->mutable_pattern()->set_kind(proto::TestPattern::GRID);
  change->update.mutable_render()->mutable_pattern()->add_modules("1");
  const auto shown = stage.show_recorded(std::move(change->update), std::move(change->assets));
  ASSERT_FALSE(shown);
  EXPECT_EQ(shown.error().message(), "pattern.modules 0: 1; the display has modules 0 to 0");
  EXPECT_FALSE(stage.has_scene());
}

TEST(FrameLog, RemembersFramesWhoseNumbersHaveGaps) {
  FrameLog log;
  const RegionOfInterest roi;
  for (const std::uint64_t frame : {4, 5, 9}) log.begun(frame, roi, "hash", Clock::time_point());
  log.shown(9, Clock::time_point());
  log.shown(7, Clock::time_point());
  EXPECT_TRUE(log.all_shown(9, 1));
  EXPECT_FALSE(log.all_shown(7, 1));
  EXPECT_FALSE(log.all_shown(5, 1));
  EXPECT_EQ(log.reports(0, 100).size(), 3U);
}

}  // namespace
}  // namespace lfd::controller
