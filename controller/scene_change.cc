// All or none.
#include "controller/scene_change.h"

#include "base/log.h"

namespace lfd::controller {

std::uint64_t SceneChange::start(const std::vector<std::string>& nodes) {
  pending_ = true;
  waiting_ = {nodes.begin(), nodes.end()};
  error_.clear();
  return ++number_;
}

void SceneChange::joins(const std::string& node) {
  if (pending_) waiting_.insert(node);
}

void SceneChange::prepared(const std::string& node, std::uint64_t number, const std::string& error) {
  if (!pending_ || number != number_ || waiting_.erase(node) == 0) return;
  if (!error.empty() && error_.empty()) error_ = fmt::format("node \"{}\": {}", node, error);
}

SceneChange::Verdict SceneChange::verdict() const {
  if (!error_.empty()) return Verdict::kRefuse;
  return waiting_.empty() ? Verdict::kShow : Verdict::kWait;
}

}  // namespace lfd::controller
