// What the log says of nodes that miss deadlines: little, and all of it.
#include "controller/late_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log.h"
#include "controller/handouts.h"

namespace lfd::controller {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

const Clock::time_point kStart{1000s};

std::vector<std::string> said(const std::vector<LateNodes::News>& news) {
  std::vector<std::string> texts;
  for (const auto& one : news) texts.push_back(one.node + (one.is_late ? " is late" : " is in time"));
  return texts;
}

TEST(LateNodes, AnEpisodeIsTwoLinesHoweverManyFramesItHas) {
  LateNodes late;
  EXPECT_THAT(said(late.swapped({"left"}, kStart)), ElementsAre("left is late"));
  for (int frame = 1; frame < 1000; ++frame) {
    const bool missed = frame % 3 != 0;
    const auto missing = missed ? std::vector<std::string>{"left"} : std::vector<std::string>{};
    EXPECT_THAT(late.swapped(missing, kStart + frame * 20ms), IsEmpty()) << frame;
    EXPECT_EQ(late.is_late("left"), missed) << frame;
  }
  const auto end = kStart + 1000 * 20ms;
  EXPECT_THAT(late.swapped({}, end), IsEmpty());
  EXPECT_THAT(said(late.swapped({}, end + LateNodes::kSure)), ElementsAre("left is in time"));
  EXPECT_THAT(late.swapped({}, end + 2 * LateNodes::kSure), IsEmpty());
  EXPECT_THAT(said(late.swapped({"left"}, end + 2 * LateNodes::kSure)), ElementsAre("left is late"));
}

TEST(LateNodes, EachIsTalkedOfForItself) {
  LateNodes late;
  EXPECT_THAT(said(late.swapped({"left", "right"}, kStart)), ElementsAre("left is late", "right is late"));
  EXPECT_THAT(late.swapped({"right"}, kStart + 1s), IsEmpty());
  EXPECT_FALSE(late.is_late("left"));
  EXPECT_TRUE(late.is_late("right"));
  EXPECT_THAT(said(late.swapped({}, kStart + LateNodes::kSure)), ElementsAre("left is in time"));
  late.gone("right");
  EXPECT_THAT(late.swapped({}, kStart + 10s), IsEmpty()) << "it is out, which was said";
}

TEST(Handouts, WhatNobodyHasLetGoOfIsBounded) {
  Handouts handouts;
  const std::string text(Handouts::kMost_bytes / 4, 'x');
  std::vector<wire::Payload> waiting;
  while (handouts.has_room() && waiting.size() < 100) waiting.push_back(handouts.give(text));
  EXPECT_EQ(waiting.size(), 4U);
  const wire::Payload copy = waiting.back();
  waiting.pop_back();
  EXPECT_FALSE(handouts.has_room()) << "a copy is still there";
  EXPECT_EQ(copy.size(), text.size());
  waiting.clear();
  EXPECT_TRUE(handouts.has_room());
}

}  // namespace
}  // namespace lfd::controller
