// FailureNews: each cause once, until it has worked for a while.
#include "base/failure_news.h"

#include <gtest/gtest.h>

namespace lfd {
namespace {

using namespace std::chrono_literals;

constexpr Clock::time_point kStart{std::chrono::hours(1)};

TEST(FailureNews, ACauseIsNewsOnce) {
  FailureNews news;
  EXPECT_TRUE(news.failed("disk full", kStart));
  EXPECT_FALSE(news.failed("disk full", kStart + 1s));
  EXPECT_TRUE(news.failed("folder gone", kStart + 2s));
  EXPECT_FALSE(news.failed("disk full", kStart + 1000h)) << "it has never worked in between";
}

TEST(FailureNews, ThatItWorksAgainIsNewsOnceAndTheNextFailureToo) {
  FailureNews news;
  EXPECT_FALSE(news.worked(kStart)) << "it has always worked";
  EXPECT_TRUE(news.failed("disk full", kStart));
  EXPECT_FALSE(news.failed("disk full", kStart + 1s));
  const auto quiet = kStart + 1s + FailureNews::kQuiet;
  EXPECT_FALSE(news.worked(quiet - 1ms));
  EXPECT_EQ(news.worked(quiet), 2u);
  EXPECT_FALSE(news.worked(quiet + 1s));
  EXPECT_TRUE(news.failed("disk full", quiet + 2s));
}

// A disk that is full but for what others remove from time to time.
TEST(FailureNews, WhatFailsAndWorksByTurnsIsNoFlood) {
  FailureNews news;
  int lines = 0;
  for (int i = 0; i < 10'000; ++i) {
    lines += news.failed("disk full", kStart + i * 10ms) ? 1 : 0;
    lines += news.worked(kStart + i * 10ms + 5ms) ? 1 : 0;
  }
  EXPECT_EQ(lines, 1);
}

TEST(FailureNews, CausesWithoutEndAreNoFlood) {
  FailureNews news;
  std::size_t lines = 0;
  for (int i = 0; i < 1000; ++i) lines += news.failed(std::to_string(i), kStart) ? 1 : 0;
  EXPECT_EQ(lines, FailureNews::kMostCauses);
}

}  // namespace
}  // namespace lfd
