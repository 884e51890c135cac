// Assets put together piece by piece: whatever the order, whatever comes twice, broken or late.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "base/hash.h"
#include "proto/asset_gatherer.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kPiece = 100;
constexpr Clock::time_point kStart{std::chrono::hours(1)};

// A scene that names one mesh a text, and a server of those texts.
struct Served {
  proto::Scene scene;
  std::map<std::string, std::string> content;
};

Served served(const std::vector<std::size_t>& sizes) {
  Served s;
  for (const std::size_t size : sizes) {
    std::string text(size, 'a');
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>('a' + (i * 7 + size) % 26);
    const std::string hash = content_hash(text);
    s.scene.add_instance()->set_mesh(hash);
    s.content[hash] = std::move(text);
  }
  return s;
}

Status answer(AssetGatherer& gatherer, const Served& s, const proto::Want& want) {
  const std::string& text = s.content.at(want.hash());
  proto::Chunk chunk;
  chunk.set_hash(want.hash());
  chunk.set_offset(want.offset());
  chunk.set_total(text.size());
  return gatherer.piece_came(chunk, std::string_view(text).substr(want.offset(), want.length()));
}

TEST(AssetGatherer, GathersEverythingInWhateverOrderPiecesCome) {
  const Served s = served({1, 99, 100, 101, 1000, 5431});
  std::mt19937 random(3);
  AssetGatherer gatherer(kPiece);
  gatherer.want(s.scene);
  std::vector<proto::Want> open;
  for (int round = 0; round < 1000 && !gatherer.complete(); ++round) {
    for (auto& want : gatherer.next_requests(kStart)) open.push_back(want);
    ASSERT_LE(open.size(), static_cast<std::size_t>(AssetGatherer::kPiecesUnderWay));
    ASSERT_FALSE(open.empty());
    std::swap(open[random() % open.size()], open.back());
    ASSERT_TRUE(answer(gatherer, s, open.back()));
    open.pop_back();
  }
  ASSERT_TRUE(gatherer.complete());
  for (const auto& [hash, text] : s.content) EXPECT_EQ(*gatherer.assets().at(hash), text);
}

TEST(AssetGatherer, HasNoMorePiecesUnderWayThanItIsTold) {
  const Served s = served({5431});
  for (const int most : {1, 3, 20}) {
    AssetGatherer gatherer(kPiece);
    gatherer.keep_under_way(most);
    gatherer.want(s.scene);
    std::vector<proto::Want> open = gatherer.next_requests(kStart);  // the first tells how long it is
    std::size_t highest = 0;
    while (!gatherer.complete()) {
      ASSERT_FALSE(open.empty());
      ASSERT_TRUE(answer(gatherer, s, open.back()));
      open.pop_back();
      for (auto& want : gatherer.next_requests(kStart)) open.push_back(want);
      highest = std::max(highest, open.size());
    }
    EXPECT_EQ(highest, static_cast<std::size_t>(most));
  }
}

TEST(AssetGatherer, AsksOnlyForWhatItLacksAndForgetsWhatNobodyNames) {
  const Served first = served({10, 20}), second = served({20, 30});
  AssetGatherer gatherer(kPiece);
  gatherer.want(first.scene);
  for (const auto& want : gatherer.next_requests(kStart)) ASSERT_TRUE(answer(gatherer, first, want));
  gatherer.want(second.scene);
  const auto requests = gatherer.next_requests(kStart);
  ASSERT_EQ(requests.size(), 1u);
  EXPECT_EQ(second.content.at(requests[0].hash()).size(), 30u);
  EXPECT_EQ(gatherer.assets().size(), 1u);
}

TEST(AssetGatherer, ForgedContentIsRefusedAndAskedForAgain) {
  const Served s = served({250});
  AssetGatherer gatherer(kPiece);
  gatherer.want(s.scene);
  proto::Chunk chunk;
  chunk.set_hash(s.content.begin()->first);
  chunk.set_total(50);
  ASSERT_EQ(gatherer.next_requests(kStart).size(), 1u);
  EXPECT_FALSE(gatherer.piece_came(chunk, std::string(50, 'x')));
  for (int round = 0; round < 10 && !gatherer.complete(); ++round) {
    for (const auto& want : gatherer.next_requests(kStart)) ASSERT_TRUE(answer(gatherer, s, want));
  }
  EXPECT_TRUE(gatherer.complete());
}

TEST(AssetGatherer, PiecesThatDoNotFitAreRefused) {
  const Served s = served({250});
  AssetGatherer gatherer(kPiece);
  gatherer.want(s.scene);
  proto::Chunk chunk;
  chunk.set_hash(s.content.begin()->first);
  chunk.set_total(250);
  chunk.set_offset(200);
  EXPECT_FALSE(gatherer.piece_came(chunk, std::string(100, 'x')));  // past the end
  chunk.set_offset(0);
  EXPECT_FALSE(gatherer.piece_came(chunk, std::string(10, 'x')));  // short
  chunk.set_total(AssetGatherer::kMaxAsset_bytes + 1);
  EXPECT_FALSE(gatherer.piece_came(chunk, std::string(100, 'x')));  // absurd
}

TEST(AssetGatherer, PiecesThatWereNotAskedForAreRefused) {
  const Served s = served({250});
  AssetGatherer gatherer(kPiece);
  gatherer.want(s.scene);
  ASSERT_EQ(gatherer.next_requests(kStart).size(), 1u);
  proto::Chunk chunk;
  chunk.set_hash(s.content.begin()->first);
  for (const std::uint64_t offset : {std::uint64_t{100}, std::uint64_t{50}, std::uint64_t{0} - 60}) {
    chunk.set_offset(offset);
    chunk.set_total(250);
    EXPECT_FALSE(gatherer.piece_came(chunk, std::string(100, 'x'))) << offset;  // the last one: its end overflows
    EXPECT_EQ(gatherer.next_requests(kStart).size(), 1u) << "it is asked for again from its beginning";
  }
}

TEST(AssetGatherer, APieceThatComesTwiceCountsOnce) {
  const Served s = served({250});
  AssetGatherer gatherer(kPiece);
  gatherer.want(s.scene);
  const auto first = gatherer.next_requests(kStart);
  ASSERT_EQ(first.size(), 1u);
  ASSERT_TRUE(answer(gatherer, s, first[0]));
  const auto others = gatherer.next_requests(kStart);
  ASSERT_EQ(others.size(), 2u);
  for (int times = 0; times < 2; ++times) ASSERT_TRUE(answer(gatherer, s, others[0]));
  EXPECT_FALSE(gatherer.complete());
  ASSERT_TRUE(answer(gatherer, s, others[1]));
  EXPECT_TRUE(gatherer.complete());
}

// The controller shows another scene by the time it reads the request: nothing stays under way for ever.
TEST(AssetGatherer, WhatIsNotFoundLeavesRoomForOthers) {
  const Served old = served({210, 220, 230, 240, 250, 260, 270, 280, 290}), next = served({300});
  AssetGatherer gatherer(kPiece);
  gatherer.want(old.scene);
  for (int round = 0; round < 5; ++round) {
    const auto requests = gatherer.next_requests(kStart);
    ASSERT_EQ(requests.size(), static_cast<std::size_t>(AssetGatherer::kPiecesUnderWay)) << "round " << round;
    for (const auto& want : requests) gatherer.not_found(want.hash());
  }
  gatherer.want(next.scene);
  for (int round = 0; round < 10 && !gatherer.complete(); ++round) {
    for (const auto& want : gatherer.next_requests(kStart)) ASSERT_TRUE(answer(gatherer, next, want));
  }
  EXPECT_TRUE(gatherer.complete());
}

TEST(AssetGatherer, ALostLinkCostsNothing) {
  const Served s = served({450});
  AssetGatherer gatherer(kPiece);
  gatherer.want(s.scene);
  for (const auto& want : gatherer.next_requests(kStart)) ASSERT_TRUE(answer(gatherer, s, want));
  ASSERT_FALSE(gatherer.next_requests(kStart).empty());  // these are lost
  gatherer.ask_again();
  for (int round = 0; round < 10 && !gatherer.complete(); ++round) {
    for (const auto& want : gatherer.next_requests(kStart)) ASSERT_TRUE(answer(gatherer, s, want));
  }
  EXPECT_TRUE(gatherer.complete());
}

// The link broke between request and answer, and nobody says so.
TEST(AssetGatherer, WhatHasNoAnswerIsAskedForAgainAndWhatCameIsKept) {
  const Served s = served({1500});
  AssetGatherer gatherer(kPiece);
  gatherer.want(s.scene);
  for (const auto& want : gatherer.next_requests(kStart)) ASSERT_TRUE(answer(gatherer, s, want));
  const auto lost = gatherer.next_requests(kStart + 1s);
  ASSERT_EQ(lost.size(), static_cast<std::size_t>(AssetGatherer::kPiecesUnderWay));
  ASSERT_TRUE(answer(gatherer, s, lost[0]));
  ASSERT_TRUE(answer(gatherer, s, lost[2]));
  auto now = kStart + 2s;
  ASSERT_EQ(gatherer.next_requests(now).size(), 2u);
  EXPECT_TRUE(gatherer.next_requests(now + AssetGatherer::kPatience).empty()) << "a slow link is no broken one";
  now += AssetGatherer::kPatience + 1ms;
  std::set<std::uint64_t> offsets;
  while (!gatherer.complete()) {
    const auto requests = gatherer.next_requests(now);
    ASSERT_FALSE(requests.empty());
    for (const auto& want : requests) {
      EXPECT_TRUE(offsets.insert(want.offset()).second) << want.offset();
      ASSERT_TRUE(answer(gatherer, s, want));
    }
  }
  EXPECT_FALSE(offsets.contains(0));
  EXPECT_FALSE(offsets.contains(lost[0].offset()));
  EXPECT_FALSE(offsets.contains(lost[2].offset()));
  EXPECT_EQ(offsets.size(), 12u);
  EXPECT_EQ(*gatherer.assets().begin()->second, s.content.begin()->second);
}

// The link was slow, not broken: both answers come, in whatever order.
TEST(AssetGatherer, AnswersThatComeTwiceAreHarmless) {
  const Served s = served({9000, 30});
  std::mt19937 random(5);
  AssetGatherer gatherer(kPiece);
  gatherer.want(s.scene);
  auto now = kStart;
  std::vector<proto::Want> open;
  for (int round = 0; round < 1000 && !gatherer.complete(); ++round) {
    for (auto& want : gatherer.next_requests(now)) open.push_back(want);
    if (round % 5 == 0) {
      now += AssetGatherer::kMostPatience + 1s;
      for (auto& want : gatherer.next_requests(now)) open.push_back(want);
    }
    ASSERT_FALSE(open.empty());
    std::swap(open[random() % open.size()], open.back());
    ASSERT_TRUE(answer(gatherer, s, open.back()));
    open.pop_back();
  }
  ASSERT_TRUE(gatherer.complete());
  for (const auto& want : open) ASSERT_TRUE(answer(gatherer, s, want));
  for (const auto& [hash, text] : s.content) EXPECT_EQ(*gatherer.assets().at(hash), text);
}

TEST(AssetGatherer, WaitsLongerEachTimeUntilAllIsHere) {
  const Served first = served({50}), second = served({60});
  AssetGatherer gatherer(kPiece);
  gatherer.want(first.scene);
  auto now = kStart;
  ASSERT_EQ(gatherer.next_requests(now).size(), 1u);
  Clock::duration patience = AssetGatherer::kPatience;
  for (int times = 0; times < 8; ++times) {
    EXPECT_TRUE(gatherer.next_requests(now + patience).empty()) << times;
    now += patience + 1ms;
    ASSERT_EQ(gatherer.next_requests(now).size(), 1u) << times;
    patience = std::min(2 * patience, AssetGatherer::kMostPatience);
  }
  proto::Want want;
  want.set_hash(first.content.begin()->first);
  want.set_length(kPiece);
  ASSERT_TRUE(answer(gatherer, first, want));
  ASSERT_TRUE(gatherer.next_requests(now).empty());
  gatherer.want(second.scene);
  ASSERT_EQ(gatherer.next_requests(now).size(), 1u);
  EXPECT_EQ(gatherer.next_requests(now + AssetGatherer::kPatience + 1ms).size(), 1u);
}

}  // namespace
}  // namespace lfd
