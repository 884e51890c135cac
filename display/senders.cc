// Names and who has them.
#include "display/senders.h"

#include <algorithm>

#include "base/log.h"

namespace lfd::display {

Result<Senders::Greeting> Senders::hello(const std::string& peer, const std::string& user, const std::string& node,
                                         Clock::time_point now) {
  if (!user.empty() && user != node) return Error(fmt::format("the key of \"{}\" speaks for no other node", user));
  if (!names_.empty() && !names_.contains(node)) return Error("it speaks for a node that is not in the deployment");
  const auto known = senders_.find(node);
  if (known == senders_.end()) {
    if (senders_.size() >= kMost) return Error(fmt::format("{} nodes send images already", kMost));
    senders_[node] = {peer, user, now};
    return Greeting{.is_new = true, .replaced = std::nullopt};
  }
  Sender& sender = known->second;
  if (sender.peer == peer) return Greeting();
  const bool may_be_dead = across_machines_ && now - sender.last_heard >= kPatience;
  if (user.empty() && !may_be_dead) return Error(fmt::format("another connection speaks for node \"{}\"", node));
  Greeting greeting{.is_new = true, .replaced = sender.peer};
  sender = {peer, user, now};
  return greeting;
}

bool Senders::is_borrowed(const std::string& peer, const std::string& user) const {
  return std::ranges::any_of(senders_,
                             [&](const auto& entry) { return entry.second.peer == peer && entry.second.user != user; });
}

std::optional<std::string> Senders::speaks_for(const std::string& node) const {
  const auto known = senders_.find(node);
  return known == senders_.end() ? std::nullopt : std::optional(known->second.peer);
}

void Senders::heard(const std::string& peer, Clock::time_point now) {
  for (auto& [node, sender] : senders_) {
    if (sender.peer == peer) sender.last_heard = now;
  }
}

void Senders::left(const std::string& peer) {
  std::erase_if(senders_, [&](const auto& entry) { return entry.second.peer == peer; });
}

std::map<std::string, std::string> Senders::peers() const {
  std::map<std::string, std::string> peers;
  for (const auto& [node, sender] : senders_) peers[node] = sender.peer;
  return peers;
}

}  // namespace lfd::display
