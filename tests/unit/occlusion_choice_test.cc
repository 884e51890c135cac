// Choosing ambient occlusion by a budget: told times, it must take the most accurate that fits.
#include "rendernode/plan/occlusion_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <tuple>

#include "base/log.h"
#include "proto/occlusion/front.h"

namespace lfd {
namespace {

using testing::HasSubstr;

proto::OcclusionFront front_of(const std::vector<std::tuple<std::string, int, double>>& entries) {
  proto::OcclusionFront front;
  for (const auto& [method, samples, mae] : entries) {
    auto* entry = front.add_entry();
    entry->mutable_ao()->set_method(method);
    entry->mutable_ao()->set_samples(samples);
    entry->set_name(fmt::format("{}, {} samples", method, samples));
    entry->set_mae(mae);
    entry->set_ratio(front.entry_size());
  }
  return front;
}

const proto::OcclusionFront kFront = front_of(
    {{"sphere", 4, 0.05}, {"starcraft", 8, 0.04}, {"march", 8, 0.03}, {"march", 32, 0.02}, {"march", 64, 0.01}});

proto::AmbientOcclusion asked(double budget_ms) {
  proto::AmbientOcclusion ao;
  ao.set_budget_ms(budget_ms);
  return ao;
}

// Times every candidate that is asked for; how many were.
int time_all(OcclusionChoice& choice, const std::function<double(const AoSettings&)>& ms_of) {
  int timed = 0;
  while (const auto next = choice.next()) {
    choice.took(ms_of(*next));
    ++timed;
  }
  return timed;
}

double by_samples(const AoSettings& ao) { return 0.1 * ao.samples; }

TEST(OcclusionChoice, TakesTheMostAccurateThatFits) {
  OcclusionChoice choice(kFront, asked(4), 10);
  EXPECT_EQ(time_all(choice, by_samples), 5);
  const auto chosen = choice.chosen();
  EXPECT_EQ(chosen.ao.method->name, "march");
  EXPECT_EQ(chosen.ao.samples, 32);
  EXPECT_THAT(chosen.why, HasSubstr("march, 32 samples: 3.2 ms of 4 ms, error 0.0200"));
  EXPECT_THAT(chosen.why, HasSubstr("march, 64 samples with 0.0100 took 6.4 ms")) << "what was just missed";
}

// A GPU may rank settings otherwise than the machine that measured the front.
TEST(OcclusionChoice, BelievesItsOwnTimes) {
  OcclusionChoice choice(kFront, asked(1), 10);
  time_all(choice, [](const AoSettings& ao) { return ao.samples == 64 ? 0.5 : 2.0; });
  EXPECT_NE(choice.chosen().ao.samples, 64) << "three in a row did not fit: it was not looked at";
  OcclusionChoice other(kFront, asked(1), 10);
  time_all(other, [](const AoSettings& ao) { return ao.samples == 8 && ao.method->name == "march" ? 0.5 : 2.0; });
  EXPECT_EQ(other.chosen().ao.samples, 8);
  EXPECT_EQ(other.chosen().ao.method->name, "march");
}

TEST(OcclusionChoice, TakesTheFastestWhereNothingFits) {
  OcclusionChoice choice(kFront, asked(0.1), 10);
  EXPECT_EQ(time_all(choice, [](const AoSettings& ao) { return ao.samples == 4 ? 0.3 : 0.2; }), 3);
  EXPECT_EQ(choice.chosen().ao.method->name, "starcraft");
  EXPECT_THAT(choice.chosen().why, HasSubstr("nothing fits in 0.1 ms; it is the fastest, with 0.2 ms"));
}

TEST(OcclusionChoice, DoesNotGoOnWhereOneIsFarTooSlow) {
  OcclusionChoice choice(kFront, asked(1), 10);
  EXPECT_EQ(time_all(choice, [](const AoSettings&) { return 100.0; }), 1);
  EXPECT_EQ(choice.chosen().ao.method->name, "sphere");
}

TEST(OcclusionChoice, KeepsWhatElseWasAskedFor) {
  proto::AmbientOcclusion ao = asked(1000);
  ao.set_radius_m(0.5);
  ao.set_half_resolution(true);
  ao.mutable_curve()->set_b(2);
  ao.mutable_curve()->set_c(3);
  OcclusionChoice choice(kFront, ao, 10);
  time_all(choice, by_samples);
  const AoSettings chosen = choice.chosen().ao;
  EXPECT_EQ(chosen.samples, 64);
  EXPECT_EQ(chosen.radius_m, 0.5);
  EXPECT_TRUE(chosen.half_resolution);
  EXPECT_EQ(chosen.curve, (occlusion::Curve{0, 2, 3}));
  proto::OcclusionFront::Entry entry;
  entry.mutable_ao()->set_method("sphere");
  entry.mutable_ao()->set_radii(5);
  EXPECT_EQ(occlusion::with_entry({}, entry).radii(), 5);
  ao.set_radii(2);
  EXPECT_EQ(occlusion::with_entry(ao, entry).radii(), 2);
}

TEST(OcclusionChoice, LeavesOutWhatCannotBeDrawnAsItWasMeasured) {
  proto::OcclusionFront front = front_of({{"march", 4, 0.03}, {"march", 8, 0.02}, {"schmitt", 0, 0.01}});
  front.mutable_entry(1)->mutable_ao()->mutable_shared()->set_neighbours(4);
  proto::AmbientOcclusion bent = asked(1000);
  bent.set_bent_normals(true);  // schmitt has no directions
  OcclusionChoice alone(front, bent, 4), together(front, bent, 5);
  EXPECT_EQ(time_all(alone, by_samples), 1);
  EXPECT_EQ(alone.chosen().ao.samples, 4);
  EXPECT_EQ(time_all(together, by_samples), 2);
  EXPECT_EQ(together.chosen().ao.shared_neighbours, 4);
  bent.mutable_shared()->set_neighbours(6);  // the user's own wish, however few modules there are
  OcclusionChoice asked_for(front, bent, 2);
  EXPECT_EQ(time_all(asked_for, by_samples), 2);
  EXPECT_EQ(asked_for.chosen().ao.shared_neighbours, 6);
  bent.clear_shared();
  OcclusionChoice none(front_of({{"schmitt", 0, 0.01}}), bent, 5);
  EXPECT_EQ(time_all(none, by_samples), 0);
  EXPECT_EQ(none.chosen().ao.method->name, "sphere");
}

TEST(OcclusionFront, TheCommittedOneCanBeDrawnAndFalls) {
  const proto::OcclusionFront& front = occlusion::committed_front();
  for (int i = 0; i < front.entry_size(); ++i) {
    proto::RenderSettings render;
    *render.mutable_ao() = front.entry(i).ao();
    EXPECT_TRUE(read_settings(render)) << front.entry(i).name();
    EXPECT_TRUE(i == 0 || front.entry(i).mae() < front.entry(i - 1).mae()) << front.entry(i).name();
    EXPECT_TRUE(i == 0 || front.entry(i).ratio() >= front.entry(i - 1).ratio()) << front.entry(i).name();
  }
}

}  // namespace
}  // namespace lfd
