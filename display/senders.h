// Decides which connection speaks for which node at the images channel: a greeting is believed only where nothing
// speaks against it. Told events and the time.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "base/clock.h"
#include "base/result.h"

namespace lfd::display {

class Senders {
 public:
  static constexpr std::size_t kMost = 256;  // nodes, where their names are not known beforehand
  static constexpr Clock::duration kPatience = std::chrono::seconds(3);

  // `names`: the nodes there are; empty: any. `across_machines`: a connection may have died without anybody knowing.
  Senders(std::set<std::string> names, bool across_machines)
      : names_(std::move(names)), across_machines_(across_machines) {}

  struct Greeting {
    bool is_new = false;                  // `peer` speaks for the node from now on
    std::optional<std::string> replaced;  // who spoke for it until now
  };

  // A connection says for which node it speaks. `user`: whose key it came with; empty: without keys. Only the node's
  // own key speaks for it. Without keys, a connection that is there keeps the name: whoever else asks for it is
  // refused, and left() the other once it is known to be gone; across machines also once it has been silent for
  // kPatience.
  Result<Greeting> hello(const std::string& peer, const std::string& user, const std::string& node,
                         Clock::time_point now);

  // Whether a connection that speaks for a node calls itself so, but greeted with another key: connections name
  // themselves, and a name is free again once its connection is gone.
  bool is_borrowed(const std::string& peer, const std::string& user) const;

  // The connection that speaks for a node, if there is one.
  std::optional<std::string> speaks_for(const std::string& node) const;

  void heard(const std::string& peer, Clock::time_point now);
  void left(const std::string& peer);

  // Peers by node.
  std::map<std::string, std::string> peers() const;

 private:
  struct Sender {
    std::string peer, user;
    Clock::time_point last_heard;
  };

  const std::set<std::string> names_;
  const bool across_machines_;
  std::map<std::string, Sender> senders_;  // by node
};

}  // namespace lfd::display
