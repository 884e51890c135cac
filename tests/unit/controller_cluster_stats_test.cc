// What a controller remembers of its cluster for people: speeds, times, faults.
#include "controller/cluster_stats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controller/cluster_page.h"

namespace lfd::controller {
namespace {

using namespace std::chrono_literals;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::SizeIs;

const Clock::time_point kStart{};

proto::Ready ready(std::uint64_t frame, double ao_ms = 0, std::uint64_t bytes = 0) {
  proto::Ready ready;
  ready.set_frame(frame);
  proto::PassTime& pass = *ready.mutable_report()->add_pass();
  pass.set_pass("ao");
  pass.set_gpu_ms(ao_ms);
  ready.mutable_report()->set_image_bytes(bytes);
  ready.mutable_report()->set_occlusion_choice("gtao: it fits");
  return ready;
}

// A cluster of the nodes "left" (modules 0, 1), "right" (2, 3) and a display.
class ClusterStatsTest : public testing::Test {
 protected:
  ClusterStatsTest() {
    for (const char* peer : {"left", "right", "display"}) stats.joined(peer);
  }

  proto::Status status_at(Clock::time_point now, const std::vector<std::uint32_t>& stale = {}) const {
    proto::Status status;
    for (const char* peer : {"display", "left", "right"}) status.add_peer()->set_name(peer);
    status.mutable_peer(0)->set_role(proto::DISPLAY);
    for (const std::uint32_t module : {0, 1}) status.mutable_peer(1)->add_module(module);
    for (const std::uint32_t module : {2, 3}) status.mutable_peer(2)->add_module(module);
    stats.fill(status, stale, now);
    return status;
  }

  ClusterStats stats{kStart};
};

TEST_F(ClusterStatsTest, NothingHasHappenedAtFirst) {
  const proto::Status status = status_at(kStart + 1500ms);
  EXPECT_EQ(status.up_s(), 1.5);
  EXPECT_EQ(status.last_fault(), "");
  EXPECT_EQ(status.shown_frames(), 0u);
  EXPECT_EQ(status.peer(1).frames_per_second(), 0);
  EXPECT_EQ(status.peer(1).begin_to_ready_ms(), 0);
}

TEST_F(ClusterStatsTest, TellsTheTimesOfTheLastFrame) {
  stats.begun(0, kStart);
  stats.ready("left", ready(0, 3, 100), kStart + 10ms);
  stats.begun(1, kStart + 12ms);
  stats.ready("right", ready(0, 4, 200), kStart + 20ms);
  stats.swapped({.frame = 0, .ready = {"left", "right"}, .missing = {}, .late = false, .begun = kStart}, kStart + 21ms);
  stats.shown("display", 0, kStart + 30ms);
  stats.ready("left", ready(1, 5, 100), kStart + 32ms);
  const proto::Status status = status_at(kStart + 33ms);
  EXPECT_EQ(status.begin_to_swap_ms(), 21);
  EXPECT_EQ(status.begin_to_shown_ms(), 30);
  EXPECT_EQ(status.shown_frames(), 1u);
  const proto::PeerStatus& left = status.peer(1);
  EXPECT_EQ(left.begin_to_ready_ms(), 20);
  EXPECT_EQ(left.image_bytes(), 200u);
  EXPECT_EQ(left.pass(0).gpu_ms(), 5);
  EXPECT_EQ(left.occlusion_choice(), "gtao: it fits");
  EXPECT_EQ(left.frames_per_second(), 1 / 0.022);
  EXPECT_EQ(status.peer(2).begin_to_ready_ms(), 20);
  EXPECT_EQ(status.peer(2).image_bytes(), 200u);
  EXPECT_EQ(status.last_fault(), "");
}

TEST_F(ClusterStatsTest, ASpeedIsThatOfTheLastSeconds) {
  for (int frame = 0; frame < 10; ++frame) {
    stats.begun(static_cast<std::uint64_t>(frame), kStart + frame * 100ms);
    stats.shown("display", static_cast<std::uint64_t>(frame), kStart + frame * 100ms);
  }
  EXPECT_NEAR(status_at(kStart + 900ms).peer(0).frames_per_second(), 10, 1e-9);
  EXPECT_EQ(status_at(kStart + 10s).peer(0).frames_per_second(), 0);
}

TEST_F(ClusterStatsTest, CountsTheStaleModulesOfEachNode) {
  const proto::Status status = status_at(kStart, {1, 2, 3});
  EXPECT_EQ(status.peer(0).stale_modules(), 0u);
  EXPECT_EQ(status.peer(1).stale_modules(), 1u);
  EXPECT_EQ(status.peer(2).stale_modules(), 2u);
}

TEST_F(ClusterStatsTest, WhoIsLateAtTheDeadlineIsAtFault) {
  stats.begun(7, kStart);
  stats.swapped({.frame = 7, .ready = {"left"}, .missing = {"right"}, .late = true, .begun = kStart}, kStart + 50ms);
  const proto::Status status = status_at(kStart + 60ms);
  const std::string what = "frame 7: late at the deadline, after 50 ms";
  const std::string day = "[0-9]+-[0-9]+-[0-9]+ [0-9]+:[0-9]+:[0-9]+ ";
  EXPECT_THAT(status.peer(2).last_fault(), MatchesRegex(day + what));
  EXPECT_THAT(status.last_fault(), MatchesRegex(day + "\"right\": " + what));
  EXPECT_EQ(status.peer(1).last_fault(), "");
}

TEST_F(ClusterStatsTest, ANodeThatDiedIsNotLate) {
  stats.swapped({.frame = 7, .ready = {"left"}, .missing = {"right"}, .late = false, .begun = kStart}, kStart + 50ms);
  EXPECT_EQ(status_at(kStart).last_fault(), "");
}

TEST_F(ClusterStatsTest, AFrameThatFailedIsAFaultAndNoFrame) {
  stats.begun(0, kStart);
  stats.begun(1, kStart);
  proto::Ready failed = ready(1, 9, 100);
  failed.mutable_report()->set_error("the GPU is gone");
  stats.ready("left", ready(0, 3, 100), kStart + 10ms);
  stats.ready("left", failed, kStart + 20ms);
  const proto::PeerStatus left = status_at(kStart + 20ms).peer(1);
  EXPECT_THAT(left.last_fault(), EndsWith("frame 1: the GPU is gone"));
  EXPECT_EQ(left.begin_to_ready_ms(), 10);
  EXPECT_EQ(left.image_bytes(), 100u);
}

TEST_F(ClusterStatsTest, TheLastFaultReplacesTheOneBefore) {
  stats.fault("left", "out: silent");
  stats.fault("right", "out: killed");
  stats.fault("", "scene: no such file");
  const proto::Status status = status_at(kStart);
  EXPECT_THAT(status.last_fault(), EndsWith(" scene: no such file"));
  EXPECT_THAT(status.peer(1).last_fault(), EndsWith(" out: silent"));
  EXPECT_THAT(status.peer(2).last_fault(), EndsWith(" out: killed"));
  EXPECT_EQ(stats.faults(""), 3u);
  EXPECT_EQ(stats.faults("left"), 1u);
}

TEST_F(ClusterStatsTest, StrangersAreCountedAndTakeNoMemory) {
  for (int i = 0; i < 1000; ++i) stats.join_refused("stranger " + std::to_string(i) + std::string(10000, 'x'), "no");
  stats.ready("nobody", ready(0), kStart);
  const proto::Status status = status_at(kStart);
  EXPECT_EQ(status.refused_messages(), 1000u);
  EXPECT_THAT(status.last_fault(), HasSubstr("\"stranger 999"));
  EXPECT_LT(status.last_fault().size(), 200u);
  EXPECT_EQ(stats.faults("stranger 7"), 0u);
}

TEST_F(ClusterStatsTest, AFaultIsCutWhereItIsTooLong) {
  stats.fault("", std::string(100'000, 'x'));
  EXPECT_LT(status_at(kStart).last_fault().size(), 600u);
}

TEST_F(ClusterStatsTest, AFrameLongForgottenHasNoTime) {
  for (std::uint64_t frame = 0; frame < 5000; ++frame) stats.begun(frame, kStart + frame * 1ms);
  stats.ready("left", ready(3), kStart + 5s);
  stats.shown("display", 3, kStart + 5s);
  EXPECT_EQ(status_at(kStart + 5s).peer(1).begin_to_ready_ms(), 0);
  EXPECT_EQ(status_at(kStart + 5s).begin_to_shown_ms(), 0);
  stats.ready("left", ready(4999), kStart + 5s);
  EXPECT_EQ(status_at(kStart + 5s).peer(1).begin_to_ready_ms(), 1);
}

TEST_F(ClusterStatsTest, ThePageHasASampleForEveryPeer) {
  const proto::Status status = status_at(kStart, {1});
  const MetricPage page = cluster_page(status, stats);
  const auto family = [&](const std::string& name) {
    for (const MetricFamily& one : page.families())
      if (one.name == name) return one;
    return MetricFamily{};
  };
  EXPECT_THAT(family("lfd_controller_peer_ready").samples, SizeIs(3));
  const MetricFamily stale = family("lfd_controller_peer_stale_modules");
  ASSERT_THAT(stale.samples, SizeIs(2)) << "of nodes alone";
  EXPECT_EQ(stale.samples[0].labels, (MetricLabels{{"peer", "left"}, {"role", "node"}}));
  EXPECT_EQ(stale.samples[0].value, 1);
  EXPECT_THAT(family("lfd_controller_frames_total").samples, SizeIs(1));
}

TEST_F(ClusterStatsTest, WhoIsRememberedNoLongerTakesNoMemory) {
  stats.joined("passer-by");
  stats.fault("passer-by", "out");
  EXPECT_EQ(stats.faults("passer-by"), 1U);
  stats.keep_only({"left", "right"});
  EXPECT_EQ(stats.faults("passer-by"), 0U);
  stats.fault("left", "out");
  EXPECT_EQ(stats.faults("left"), 1U);
}

}  // namespace
}  // namespace lfd::controller
