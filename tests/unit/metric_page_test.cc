// Metrics as plain values: buckets of durations, families of samples, what nodes and displays count.
#include "base/metric_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "display/display_stats.h"
#include "rendernode/node/node_stats.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

MetricFamily family_of(const MetricPage& page, const std::string& name) {
  for (const MetricFamily& one : page.families())
    if (one.name == name) return one;
  ADD_FAILURE() << "no " << name;
  return {};
}

double value_of(const MetricPage& page, const std::string& name) { return family_of(page, name).samples.at(0).value; }

std::uint64_t count_of(const DurationHistogram& histogram) {
  return std::accumulate(histogram.counts().begin(), histogram.counts().end(), std::uint64_t{0});
}

TEST(DurationHistogram, ABucketHoldsWhatIsAtMostItsBound) {
  DurationHistogram histogram;
  ASSERT_EQ(DurationHistogram::bounds_s()[1], 0.001);
  histogram.observe_ms(1);
  histogram.observe_ms(1.001);
  histogram.observe_ms(0);
  histogram.observe_ms(1e9);
  EXPECT_EQ(histogram.counts()[0], 1u);
  EXPECT_EQ(histogram.counts()[1], 1u);
  EXPECT_EQ(histogram.counts()[2], 1u);
  EXPECT_EQ(histogram.counts().back(), 1u);
  EXPECT_EQ(count_of(histogram), 4u);
  EXPECT_DOUBLE_EQ(histogram.sum_s(), 0.001 + 0.001001 + 1e6);
}

TEST(MetricPage, SamplesOfOneNameAreOneFamilyAndHaveTheCommonLabelsFirst) {
  MetricPage page(MetricLabels{{"node", "left"}});
  page.gauge("a", "of a", 1, {{"x", "1"}});
  page.counter("b", "of b", 2);
  page.gauge("a", "of a", 3, {{"x", "2"}});
  ASSERT_EQ(page.families().size(), 2u);
  const MetricFamily a = family_of(page, "a");
  ASSERT_EQ(a.samples.size(), 2u);
  EXPECT_EQ(a.samples[1].labels, (MetricLabels{{"node", "left"}, {"x", "2"}}));
  EXPECT_EQ(a.samples[1].value, 3);
  EXPECT_EQ(family_of(page, "b").kind, MetricKind::kCounter);
}

TEST(NodeStats, TimesFramesFromTheirBegin) {
  node::NodeStats stats;
  const Clock::time_point start{};
  stats.joined(3);
  stats.begun(5, start);
  stats.drawn(5, start + 10ms);
  proto::NodeReport report;
  for (const double ms : {1.0, 2.0}) {  // each module by itself
    proto::PassTime& pass = *report.add_pass();
    pass.set_pass("ao");
    pass.set_gpu_ms(ms);
  }
  proto::PassTime& readback = *report.add_pass();
  readback.set_pass("readback");
  readback.set_cpu_ms(7);
  stats.ready(5, report, start + 20ms);
  stats.ready(4, report, start + 20ms);  // begun before it joined: no time, but a frame
  report.set_error("no");
  stats.ready(6, report, start + 30ms);
  stats.sent_image(100);
  stats.sent_image(50);
  const MetricPage page = stats.page("left", {.is_member = true, .sequence = 9, .dropped_frames = 2});
  EXPECT_EQ(value_of(page, "lfd_node_frames_total"), 2);
  EXPECT_EQ(value_of(page, "lfd_node_failed_frames_total"), 1);
  EXPECT_EQ(value_of(page, "lfd_node_dropped_frames_total"), 2);
  EXPECT_EQ(value_of(page, "lfd_node_modules"), 3);
  EXPECT_EQ(value_of(page, "lfd_node_state_sequence"), 9);
  EXPECT_EQ(value_of(page, "lfd_node_image_bytes_total"), 150);
  EXPECT_DOUBLE_EQ(family_of(page, "lfd_node_begin_to_drawn_seconds").samples[0].histogram.sum_s(), 0.01);
  EXPECT_DOUBLE_EQ(family_of(page, "lfd_node_begin_to_ready_seconds").samples[0].histogram.sum_s(), 0.02);
  const MetricFamily stages = family_of(page, "lfd_node_stage_seconds");
  ASSERT_EQ(stages.samples.size(), 2u);
  EXPECT_EQ(stages.samples[0].labels, (MetricLabels{{"node", "left"}, {"pass", "ao"}}));
  EXPECT_DOUBLE_EQ(stages.samples[0].histogram.sum_s(), 0.006);
  EXPECT_EQ(count_of(stages.samples[0].histogram), 2u);
  EXPECT_DOUBLE_EQ(stages.samples[1].histogram.sum_s(), 0.014);
}

TEST(DisplayStats, TimesFramesFromOneToTheNext) {
  display::DisplayStats stats;
  const Clock::time_point start{};
  stats.joined(4);
  stats.image_came(10);
  stats.shown(4, start);
  stats.shown(3, start + 20ms);
  stats.joined(4);
  stats.shown(2, start + 10s);
  const MetricPage page = stats.page("wall", {.is_member = false, .nodes = 2, .dropped_frames = 5});
  EXPECT_EQ(value_of(page, "lfd_display_shown_frames_total"), 3);
  EXPECT_EQ(value_of(page, "lfd_display_fresh_modules"), 2);
  EXPECT_EQ(value_of(page, "lfd_display_dropped_frames_total"), 5);
  EXPECT_EQ(value_of(page, "lfd_display_joins_total"), 2);
  EXPECT_DOUBLE_EQ(family_of(page, "lfd_display_shown_interval_seconds").samples[0].histogram.sum_s(), 0.02)
      << "while it was away nothing could be shown";
}

}  // namespace
}  // namespace lfd
