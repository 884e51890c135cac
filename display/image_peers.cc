// Hellos and credits.
#include "display/image_peers.h"

#include <algorithm>

namespace lfd::display {
namespace {

constexpr std::size_t kMaxName_bytes = 1000;

}  // namespace

Result<bool> ImagePeers::hello(const std::string& peer, const std::string& node, Clock::time_point now) {
  const auto known = peers_.find(peer);
  if (known != peers_.end() && known->second.node == node) return false;
  if (node.empty() || node.size() > kMaxName_bytes) return Error("not the name of a node");
  LFD_TRY_STATUS(assembly_.node_came(node, now));
  if (known != peers_.end()) assembly_.node_left(known->second.node, now);
  std::erase_if(peers_, [&](const auto& entry) { return entry.second.node == node || entry.first == peer; });
  peers_[peer] = {node, false};
  strangers_.erase(peer);
  return true;
}

std::optional<std::string> ImagePeers::sender(const std::string& peer) {
  const auto known = peers_.find(peer);
  if (known != peers_.end()) return known->second.node;
  strangers_.insert(peer);
  return std::nullopt;
}

std::optional<std::string> ImagePeers::gone(const std::string& peer, Clock::time_point now) {
  const auto known = peers_.find(peer);
  if (known == peers_.end()) return std::nullopt;
  std::string node = known->second.node;
  assembly_.node_left(node, now);
  peers_.erase(known);
  return node;
}

void ImagePeers::restart(Clock::time_point now) {
  for (auto at = peers_.begin(); at != peers_.end();) {
    const auto here = at++;
    if (here->second.has_credit) forget(here, now);
  }
}

void ImagePeers::forget(std::map<std::string, Peer>::iterator peer, Clock::time_point now) {
  assembly_.node_left(peer->second.node, now);
  strangers_.insert(peer->first);
  peers_.erase(peer);
}

std::vector<ImagePeers::Words> ImagePeers::words(Clock::time_point now) {
  for (auto at = peers_.begin(); at != peers_.end();) {
    const auto here = at++;
    if (assembly_.has_lost_touch(here->second.node)) forget(here, now);
  }
  std::vector<Words> words;
  for (const std::string& stranger : strangers_) {
    words.push_back({stranger, {}});
    words.back().credit.set_anew(true);
  }
  strangers_.clear();
  const bool probes = now - probed_at_ >= kProbePause;
  if (probes) probed_at_ = now;
  for (auto& [id, peer] : peers_) {
    const std::uint32_t images = assembly_.credit_for(peer.node);
    if (images == 0 && !probes) continue;
    words.push_back({id, {}});
    words.back().credit.set_images(images);
    if (images == 0 || peer.has_credit) continue;
    words.back().credit.set_anew(true);
    peer.has_credit = true;
  }
  return words;
}

}  // namespace lfd::display
