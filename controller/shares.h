// Decides who draws whose modules: a spare stands in for a node that is out. Told who is there.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "controller/assignment.h"
#include "proto/deployment.pb.h"

namespace lfd::controller {

// What is known of a node. kLoading: it lives, and cannot draw yet.
enum class Presence { kAway, kLoading, kReady };

// Every node has a share: the modules it holds ready to draw. That of a node with modules of its own never changes; a
// spare takes over the share of a node that is out, and keeps it, warm, after it has given it back, until it is needed
// elsewhere. In each frame the modules of a node are drawn by the node itself or by the spare that stands in for it,
// never by both.
class Shares {
 public:
  // `own`: of all nodes, spares with no modules.
  Shares(Assignment own, std::vector<std::string> spares, proto::Deployment::GiveBack give_back);

  // Whom the cluster has now. Returns the spares that have got another share, and are to be told: they count as loading
  // until they have said its number and that they can draw it.
  std::vector<std::string> settle(const std::map<std::string, Presence>& presence);

  // The share of a node as it is to be told, and its number: another one whenever the modules are others.
  const std::vector<std::uint32_t>& of(const std::string& node) const { return held_.at(node).modules; }
  std::uint64_t number(const std::string& node) const { return held_.at(node).number; }

  // Who draws the next frame, and what: nodes that are ready, without those that have nothing to draw.
  Assignment drawing(const std::map<std::string, Presence>& presence) const;

  bool is_spare(const std::string& node) const;
  // The node whose modules the spare draws now; empty: none.
  std::string stands_in_for(const std::string& spare) const;

 private:
  struct Held {
    std::vector<std::uint32_t> modules;
    std::uint64_t number = 0;
    std::string owner;    // of a spare: whose modules they are; empty: none yet
    bool active = false;  // of a spare: it stands in for the owner
  };

  void give_back(const std::map<std::string, Presence>& presence);
  std::string free_spare_for(const std::string& owner, const std::map<std::string, Presence>& presence) const;
  bool is_stood_in_for(const std::string& owner) const;

  Assignment own_;
  std::vector<std::string> spares_;
  proto::Deployment::GiveBack give_back_;
  std::map<std::string, Held> held_;
};

}  // namespace lfd::controller
