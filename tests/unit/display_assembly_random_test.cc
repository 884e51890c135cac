// Over random orders of arrival no frame is ever mixed, lost without need, or paid for with unbounded memory.
#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <numeric>
#include <random>

#include "tests/unit/one_pixel_images.h"

namespace lfd::display {
namespace {

const Clock::time_point kStart{};

// Nodes that send frame after frame as far as their credits go, and a controller whose swaps come in order; who moves
// next is random.
class Cluster {
 public:
  // `ahead`: so many frames are swapped at most beyond the last one shown.
  Cluster(unsigned seed, std::uint64_t ahead, double stale_share, double drop_share)
      : ahead_(ahead), random_(seed), nodes_(1 + random_() % 4), modules_(nodes_ * (1 + random_() % 3)) {
    assembly_.configure(static_cast<int>(modules_), kOnePixel);
    queues_.resize(nodes_);
    credits_.resize(nodes_);
    for (std::uint32_t node = 0; node < nodes_; ++node) EXPECT_TRUE(assembly_.node_came(std::to_string(node), kStart));
    for (std::uint64_t frame = 1; frame <= kFrames; ++frame) plan(frame, stale_share, drop_share);
  }

  void run() {
    for (int idle = 0; idle < 200;) idle = step() ? 0 : idle + 1;
    EXPECT_TRUE(swaps_.empty());
    for (const auto& queue : queues_) EXPECT_TRUE(queue.empty()) << "a node was left without credit";
  }

  static constexpr std::uint64_t kFrames = 40;
  std::vector<std::uint64_t> shown_;

 private:
  std::uint32_t per_node() const { return modules_ / nodes_; }
  bool chance(double share) { return std::uniform_real_distribution<double>(0, 1)(random_) < share; }

  void plan(std::uint64_t frame, double stale_share, double drop_share) {
    std::vector<std::uint32_t> stale;
    for (std::uint32_t node = 0; node < nodes_; ++node) {
      const bool is_stale = chance(stale_share);
      for (std::uint32_t i = 0; i < per_node(); ++i) {
        const std::uint32_t module = node * per_node() + i;
        if (is_stale) stale.push_back(module);
        if (!chance(is_stale ? 0.5 : drop_share)) queues_[node].push_back(image_of(frame, module, per_node()));
      }
    }
    swaps_.emplace_back(frame, stale);
  }

  bool step() {
    bool moved = false;
    const std::uint32_t who = random_() % (nodes_ + 1);
    if (who == nodes_) {
      const std::uint64_t last = shown_.empty() ? 0 : shown_.back();
      moved = !swaps_.empty() && swaps_.front().first <= last + ahead_;
      if (moved) {
        stale_of_[swaps_.front().first] = swaps_.front().second;
        assembly_.swapped(swaps_.front().first, swaps_.front().second);
        swaps_.pop_front();
      }
    } else {
      moved = !queues_[who].empty() && credits_[who] > 0;
      if (moved) {
        const proto::Image image = queues_[who].front();
        queues_[who].pop_front();
        --credits_[who];
        (void)static_cast<bool>(
            assembly_.image_came(std::to_string(who), image, pixel_of(image.frame(), image.module()), kStart));
      }
      credits_[who] += assembly_.credit_for(std::to_string(who));
    }
    // The first credit is for as many images as the display has modules; after that it is two frames.
    EXPECT_LE(assembly_.waiting_images(), nodes_ * std::max(NodeCredit::kFramesPerNode * per_node(), modules_));
    while (const auto frame = assembly_.next_frame(kStart)) check(*frame), moved = true;
    return moved;
  }

  void check(const ShownFrame& shown) {
    if (!shown_.empty()) {
      EXPECT_GT(shown.frame, shown_.back());
    }
    shown_.push_back(shown.frame);
    ASSERT_EQ(shown.modules.size(), modules_);
    ASSERT_TRUE(stale_of_.contains(shown.frame)) << "never swapped";
    const auto& stale = stale_of_[shown.frame];
    for (std::uint32_t m = 0; m < modules_; ++m) {
      const ShownModule& module = shown.modules[m];
      const bool is_stale = std::find(stale.begin(), stale.end(), m) != stale.end();
      EXPECT_EQ(module.stale, is_stale);
      if (module.image[proto::COLOR] == nullptr) {
        EXPECT_TRUE(is_stale);
        continue;
      }
      EXPECT_EQ(module.frame < shown.frame, is_stale);
      EXPECT_LE(module.frame, shown.frame);
      EXPECT_EQ(module.image[proto::COLOR]->payload.text(), pixel_of(module.frame, m).text());
    }
  }

  const std::uint64_t ahead_;
  std::mt19937 random_;
  std::uint32_t nodes_, modules_;
  FrameAssembly assembly_;
  std::vector<std::deque<proto::Image>> queues_;
  std::vector<std::uint32_t> credits_;
  std::deque<std::pair<std::uint64_t, std::vector<std::uint32_t>>> swaps_;
  std::map<std::uint64_t, std::vector<std::uint32_t>> stale_of_;
};

TEST(DisplayAssembly, RandomOrdersShowEveryFrameOnceAndWhole) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Cluster cluster(seed, 4, 0, 0);
    cluster.run();
    std::vector<std::uint64_t> all(Cluster::kFrames);
    std::iota(all.begin(), all.end(), 1u);
    EXPECT_EQ(cluster.shown_, all);
  }
}

TEST(DisplayAssembly, RandomStalenessAndLossesNeverMixFramesAndNeverStopTheDisplay) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Cluster cluster(seed, Cluster::kFrames, 0.2, 0.05);
    cluster.run();
    EXPECT_FALSE(cluster.shown_.empty());
  }
}

}  // namespace
}  // namespace lfd::display
