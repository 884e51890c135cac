// However large images are, what waits of a node stays within the bound.
#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "display/node_credit.h"

namespace lfd::display {
namespace {

TEST(NodeCredit, BeginsWithWhatCanBeTakenWhateverItIs) {
  NodeCredit credit;
  EXPECT_EQ(credit.give({.waiting_bytes = 800, .largest_image_bytes = 100, .modules = 16}), 8u);
  EXPECT_EQ(credit.give({.waiting_bytes = 800, .largest_image_bytes = 100, .modules = 16}), 0u) << "given once";
  EXPECT_EQ(NodeCredit().give({.waiting_bytes = 800, .largest_image_bytes = 100, .modules = 4}), 4u);
  EXPECT_EQ(NodeCredit().give({.waiting_bytes = 8, .largest_image_bytes = 100, .modules = 4}), 1u);
}

TEST(NodeCredit, ImagesWithoutCreditAreRefused) {
  NodeCredit credit;
  EXPECT_FALSE(credit.use());
  credit.give({.waiting_bytes = 100, .largest_image_bytes = 100, .modules = 16});
  EXPECT_TRUE(credit.use());
  EXPECT_FALSE(credit.use());
}

// Images of random sizes, frames of random lengths, releases at random times.
TEST(NodeCredit, WhatWaitsStaysWithinTheBound) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const CreditLimits limits{.waiting_bytes = 100 * (1 + random() % 30), .largest_image_bytes = 160, .modules = 10};
    NodeCredit credit;
    std::deque<std::size_t> waiting;
    std::size_t bytes = 0, most_of_images = 1;
    std::uint32_t taken = 0;
    for (int step = 0; step < 500; ++step) {
      const std::uint32_t of_images = 1 + random() % 20;
      for (std::uint32_t i = 0; i < of_images; ++i) {
        credit.give(limits);
        if (!credit.use()) break;
        const std::size_t pixels = random() % 2 == 0 ? 40 : 160;
        const std::size_t size = random() % (pixels + 1);
        if (!credit.fits(limits, size, of_images)) continue;
        most_of_images = std::max<std::size_t>(most_of_images, of_images);
        credit.waits(size, pixels, of_images);
        waiting.push_back(size);
        bytes += size;
        ++taken;
        EXPECT_LE(bytes, std::max(limits.waiting_bytes, most_of_images * limits.largest_image_bytes)) << seed;
        EXPECT_LE(waiting.size(), std::max<std::size_t>(NodeCredit::kFramesPerNode * most_of_images, limits.modules));
      }
      while (!waiting.empty() && random() % 8 > 0) {
        credit.released(1, waiting.front());
        bytes -= waiting.front();
        waiting.pop_front();
      }
    }
    EXPECT_GT(taken, 500u) << "it goes on";
  }
}

TEST(NodeCredit, AWholeFrameAlwaysFits) {
  const CreditLimits limits{.waiting_bytes = 1, .largest_image_bytes = 160, .modules = 10};
  NodeCredit credit;
  std::uint32_t more = credit.give(limits);
  EXPECT_EQ(more, 1u);
  for (int image = 0; image < 30; ++image) {
    ASSERT_TRUE(credit.use()) << image;
    ASSERT_TRUE(credit.fits(limits, 160, 30));
    credit.waits(160, 160, 30);
    credit.give(limits);
  }
  EXPECT_FALSE(credit.use());
}

}  // namespace
}  // namespace lfd::display
