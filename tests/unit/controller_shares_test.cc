// Shares: spares stand in for nodes that are out, in every order of events.
#include "controller/shares.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "base/log.h"

namespace lfd::controller {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;
using enum Presence;
using Modules = std::vector<std::uint32_t>;

const Assignment kOwn{{"a", {0, 1}}, {"b", {2, 3}}, {"s", {}}, {"t", {}}};

Shares shares_with(proto::Deployment::GiveBack give_back) { return Shares(kOwn, {"s", "t"}, give_back); }

TEST(Shares, SparesRestWhileEverybodyIsThere) {
  Shares shares = shares_with(proto::Deployment::WHEN_READY);
  const std::map<std::string, Presence> all{{"a", kReady}, {"b", kReady}, {"s", kReady}, {"t", kReady}};
  EXPECT_THAT(shares.settle(all), IsEmpty());
  EXPECT_THAT(shares.drawing(all), ElementsAre(Pair("a", Modules{0, 1}), Pair("b", Modules{2, 3})));
  EXPECT_THAT(shares.of("s"), IsEmpty());
}

TEST(Shares, ANodeThatIsNotReadyYetIsNotReplaced) {
  Shares shares = shares_with(proto::Deployment::WHEN_READY);
  const std::map<std::string, Presence> loading{{"a", kLoading}, {"b", kReady}, {"s", kReady}, {"t", kReady}};
  EXPECT_THAT(shares.settle(loading), IsEmpty());
  EXPECT_THAT(shares.drawing(loading), ElementsAre(Pair("b", Modules{2, 3})));
}

TEST(Shares, ASpareTakesOverOnceItCanDraw) {
  Shares shares = shares_with(proto::Deployment::WHEN_READY);
  std::map<std::string, Presence> now{{"a", kAway}, {"b", kReady}, {"s", kReady}, {"t", kReady}};
  const std::uint64_t before = shares.number("s");
  EXPECT_THAT(shares.settle(now), ElementsAre("s"));
  EXPECT_NE(shares.number("s"), before);
  EXPECT_EQ(shares.of("s"), (Modules{0, 1}));
  EXPECT_EQ(shares.stands_in_for("s"), "a");
  now["s"] = kLoading;
  EXPECT_THAT(shares.settle(now), IsEmpty());
  EXPECT_THAT(shares.drawing(now), ElementsAre(Pair("b", Modules{2, 3})));
  now["s"] = kReady;
  EXPECT_THAT(shares.drawing(now), ElementsAre(Pair("b", Modules{2, 3}), Pair("s", Modules{0, 1})));
}

TEST(Shares, ItGivesBackWhenTheNodeIsReadyAndStaysWarm) {
  Shares shares = shares_with(proto::Deployment::WHEN_READY);
  std::map<std::string, Presence> now{{"a", kAway}, {"b", kReady}, {"s", kReady}, {"t", kAway}};
  shares.settle(now);
  now["a"] = kLoading;
  EXPECT_THAT(shares.settle(now), IsEmpty());
  EXPECT_THAT(shares.drawing(now), ElementsAre(Pair("b", Modules{2, 3}), Pair("s", Modules{0, 1})));
  now["a"] = kReady;
  EXPECT_THAT(shares.settle(now), IsEmpty());
  EXPECT_THAT(shares.drawing(now), ElementsAre(Pair("a", Modules{0, 1}), Pair("b", Modules{2, 3})));
  const std::uint64_t number = shares.number("s");
  now["a"] = kAway;
  EXPECT_THAT(shares.settle(now), IsEmpty()) << "the spare holds those modules already";
  EXPECT_EQ(shares.number("s"), number);
  EXPECT_THAT(shares.drawing(now), ElementsAre(Pair("b", Modules{2, 3}), Pair("s", Modules{0, 1})));
}

TEST(Shares, ItKeepsThemByPolicyUntilItGoes) {
  Shares shares = shares_with(proto::Deployment::NEVER);
  std::map<std::string, Presence> now{{"a", kAway}, {"b", kReady}, {"s", kReady}, {"t", kAway}};
  shares.settle(now);
  now["a"] = kReady;
  shares.settle(now);
  EXPECT_THAT(shares.drawing(now), ElementsAre(Pair("b", Modules{2, 3}), Pair("s", Modules{0, 1})));
  now["s"] = kAway;
  shares.settle(now);
  EXPECT_THAT(shares.drawing(now), ElementsAre(Pair("a", Modules{0, 1}), Pair("b", Modules{2, 3})));
}

TEST(Shares, ASpareThatCannotDrawYetIsNotWaitedForByWhoCan) {
  Shares shares = shares_with(proto::Deployment::NEVER);
  std::map<std::string, Presence> now{{"a", kAway}, {"b", kReady}, {"s", kReady}, {"t", kAway}};
  ASSERT_THAT(shares.settle(now), ElementsAre("s"));
  now["s"] = kLoading;
  now["a"] = kReady;
  shares.settle(now);
  EXPECT_THAT(shares.drawing(now), ElementsAre(Pair("a", Modules{0, 1}), Pair("b", Modules{2, 3})));
}

TEST(Shares, AnotherSpareStandsInForOneThatGoes) {
  Shares shares = shares_with(proto::Deployment::WHEN_READY);
  std::map<std::string, Presence> now{{"a", kAway}, {"b", kReady}, {"s", kReady}, {"t", kReady}};
  ASSERT_THAT(shares.settle(now), ElementsAre("s"));
  now["s"] = kAway;
  EXPECT_THAT(shares.settle(now), ElementsAre("t"));
  now["b"] = kAway;
  EXPECT_THAT(shares.settle(now), IsEmpty()) << "there is no other spare";
  now["s"] = kReady;
  EXPECT_THAT(shares.settle(now), ElementsAre("s"));
  EXPECT_EQ(shares.stands_in_for("s"), "b");
}

// Whatever comes and goes: no module is drawn twice; one is left out only where nobody could draw it.
TEST(Shares, NoModuleHasTwoDrawersInAnyOrderOfEvents) {
  for (const auto give_back : {proto::Deployment::WHEN_READY, proto::Deployment::NEVER}) {
    Shares shares = shares_with(give_back);
    std::mt19937 random(7);
    std::map<std::string, Presence> now{{"a", kAway}, {"b", kAway}, {"s", kAway}, {"t", kAway}};
    std::map<std::string, std::uint64_t> told;
    for (int step = 0; step < 20000; ++step) {
      const std::string node = std::next(now.begin(), static_cast<int>(random() % 4))->first;
      now[node] = static_cast<Presence>(random() % 3);
      if (now[node] == kLoading) told[node] = shares.number(node);
      for (const std::string& changed : shares.settle(now)) {
        if (now[changed] == kReady) now[changed] = kLoading;  // as the controller counts it
        told[changed] = shares.number(changed);
      }
      if (now[node] == kReady) told[node] = shares.number(node);
      std::map<std::uint32_t, std::string> drawer;
      for (const auto& [name, modules] : shares.drawing(now)) {
        EXPECT_EQ(now[name], kReady);
        EXPECT_EQ(told[name], shares.number(name)) << name;
        for (const std::uint32_t module : modules) EXPECT_TRUE(drawer.emplace(module, name).second) << module;
      }
      for (const auto& [owner, modules] : {*kOwn.find("a"), *kOwn.find("b")}) {
        if (drawer.contains(modules[0])) continue;
        const bool stood_in_for = shares.stands_in_for("s") == owner || shares.stands_in_for("t") == owner;
        EXPECT_TRUE(now[owner] != kReady || stood_in_for) << owner;
        if (now[owner] != kAway || stood_in_for) continue;
        for (const std::string spare : {"s", "t"}) {
          EXPECT_TRUE(now[spare] == kAway || !shares.stands_in_for(spare).empty()) << spare << " rests";
        }
      }
    }
  }
}

}  // namespace
}  // namespace lfd::controller
