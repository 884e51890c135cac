// Gathering assets piece by piece.
#include "proto/asset_gatherer.h"

#include <algorithm>
#include <utility>

#include "base/hash.h"
#include "base/log.h"

namespace lfd {
namespace {

// As long as `size`, without taking more than twice that, or more than `total`: what somebody says that an asset has
// costs nothing before it comes.
void grow(std::string& bytes, std::uint64_t size, std::uint64_t total) {
  if (bytes.size() >= size) return;
  if (bytes.capacity() < size) bytes.reserve(std::min(total, std::max<std::uint64_t>(size, 2 * bytes.capacity())));
  bytes.resize(size);
}

}  // namespace

std::set<std::string> asset_hashes(const proto::Scene& scene) {
  std::set<std::string> hashes;
  for (const auto& instance : scene.instance()) hashes.insert(instance.mesh());
  for (const auto& material : scene.material()) {
    if (material.has_texture()) hashes.insert(material.texture().picture());
  }
  return hashes;
}

void AssetGatherer::want(const proto::Scene& scene, const proto::Scene* next) {
  std::set<std::string> wanted = asset_hashes(scene);
  if (next != nullptr) wanted.merge(asset_hashes(*next));
  std::erase_if(assets_, [&](const auto& asset) { return !wanted.contains(asset.first); });
  std::erase_if(missing_, [&](const auto& partial) { return !wanted.contains(partial.first); });
  for (const auto& hash : wanted) {
    if (!assets_.contains(hash)) missing_.try_emplace(hash);
  }
}

bool AssetGatherer::has_all_of(const proto::Scene& scene) const {
  return std::ranges::all_of(asset_hashes(scene), [&](const std::string& hash) { return assets_.contains(hash); });
}

std::vector<proto::Want> AssetGatherer::next_requests(Clock::time_point now) {
  if (std::exchange(answered_, false)) last_news_ = now;
  if (missing_.empty()) patience_ = kPatience;
  if (!missing_.empty() && under_way_ > 0 && now - last_news_ > patience_) {
    log::info("no asset has come for {:.0f} ms; what is missing is asked for again", milliseconds(now - last_news_));
    ask_again();
    patience_ = std::min(2 * patience_, kMostPatience);
  }
  std::vector<proto::Want> requests;
  for (auto& [hash, partial] : missing_) {
    // The first piece tells how long the asset is; until then nothing more of it is asked for.
    while (under_way_ < most_under_way_ && (partial.next == 0 || partial.next < partial.total)) {
      const std::uint64_t offset = std::exchange(partial.next, partial.next + piece_bytes_);
      if (partial.has(offset / piece_bytes_)) continue;
      partial.asked = std::max(partial.asked, partial.next);
      proto::Want want;
      want.set_hash(hash);
      want.set_offset(offset);
      want.set_length(piece_bytes_);
      ++under_way_;
      requests.push_back(std::move(want));
    }
  }
  if (!requests.empty()) last_news_ = now;
  return requests;
}

Status AssetGatherer::piece_came(const proto::Chunk& chunk, std::string_view bytes) {
  answer_came();
  const auto found = missing_.find(chunk.hash());
  if (found == missing_.end()) return {};  // no longer wanted
  Partial& partial = found->second;
  const std::uint64_t left = chunk.total() - std::min<std::uint64_t>(chunk.offset(), chunk.total());
  const bool was_asked = chunk.offset() < partial.asked && chunk.offset() % piece_bytes_ == 0;
  const bool is_whole = bytes.size() == std::min<std::uint64_t>(piece_bytes_, left);
  const bool agrees = partial.here == 0 || partial.total == chunk.total();
  if (chunk.total() > kMaxAsset_bytes || !was_asked || !is_whole || !agrees) {
    partial = {};
    return Error(fmt::format("asset {}: a piece of {} bytes at {} of {} does not fit", chunk.hash(), bytes.size(),
                             chunk.offset(), chunk.total()));
  }
  partial.total = chunk.total();
  const std::uint64_t piece = chunk.offset() / piece_bytes_;
  if (partial.has(piece)) return {};  // asked for twice, since the link was lost in between
  if (partial.pieces.size() <= piece) partial.pieces.resize(piece + 1);
  partial.pieces[piece] = true;
  grow(partial.bytes, chunk.offset() + bytes.size(), partial.total);
  std::ranges::copy(bytes, partial.bytes.begin() + static_cast<std::ptrdiff_t>(chunk.offset()));
  partial.here += bytes.size();
  if (partial.here < partial.total) return {};
  if (content_hash(partial.bytes) != chunk.hash()) {
    partial = {};
    return Error(fmt::format("asset {}: what came has another hash", chunk.hash()));
  }
  assets_[chunk.hash()] = std::make_shared<const std::string>(std::move(partial.bytes));
  missing_.erase(found);
  return {};
}

void AssetGatherer::not_found(const std::string& hash) {
  answer_came();
  if (const auto found = missing_.find(hash); found != missing_.end()) found->second = {};
}

void AssetGatherer::ask_again() {
  under_way_ = 0;
  for (auto& [hash, partial] : missing_) partial.next = 0;
}

// Of what was asked for twice both answers may come: what is under way is never counted below nothing.
void AssetGatherer::answer_came() {
  under_way_ = std::max(0, under_way_ - 1);
  answered_ = true;
}

}  // namespace lfd
