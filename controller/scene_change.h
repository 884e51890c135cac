// Decides when a scene that is to come is shown: once every node that draws has prepared it, or not at all.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lfd::controller {

// One change at a time. Nodes go on drawing the old scene while they prepare the new one, so there is no limit of time:
// a node that hangs is out by its silence.
class SceneChange {
 public:
  // A new change, which `nodes` are to prepare; its number.
  std::uint64_t start(const std::vector<std::string>& nodes);
  // While it is pending: another node is to prepare it too, and is waited for like the others.
  void joins(const std::string& node);

  bool is_pending() const { return pending_; }
  std::uint64_t number() const { return number_; }

  // Events. Those of another number have no effect. `error`: it cannot be drawn there; empty: it is prepared.
  void prepared(const std::string& node, std::uint64_t number, const std::string& error);
  // The node is out, has joined anew or draws other modules: what it may have prepared is lost. Unless it joins again,
  // it will take the scene as one that comes late.
  void gone(const std::string& node) { waiting_.erase(node); }

  enum class Verdict { kWait, kShow, kRefuse };
  Verdict verdict() const;
  // Why it is refused: what the first node said.
  const std::string& error() const { return error_; }

  // It has been shown, or refused.
  void finish() { pending_ = false; }

 private:
  bool pending_ = false;
  std::uint64_t number_ = 0;
  std::set<std::string> waiting_;
  std::string error_;
};

}  // namespace lfd::controller
