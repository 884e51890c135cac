// One entry for every node that is late now and then.
#include "controller/late_nodes.h"

#include <algorithm>

namespace lfd::controller {

std::vector<LateNodes::News> LateNodes::swapped(const std::vector<std::string>& missing, Clock::time_point now) {
  std::vector<News> news;
  for (Entry& entry : entries_) entry.missed_last = false;
  for (const std::string& node : missing) {
    auto entry = std::ranges::find(entries_, node, &Entry::node);
    if (entry == entries_.end()) {
      news.push_back({node, true});
      entry = entries_.insert(entry, {.node = node, .last_late = now});
    }
    entry->last_late = now;
    entry->missed_last = true;
  }
  std::erase_if(entries_, [&](const Entry& entry) {
    const bool in_time = now - entry.last_late >= kSure;
    if (in_time) news.push_back({entry.node, false});
    return in_time;
  });
  return news;
}

void LateNodes::gone(const std::string& node) {
  std::erase_if(entries_, [&](const Entry& entry) { return entry.node == node; });
}

bool LateNodes::is_late(const std::string& node) const {
  return std::ranges::any_of(entries_, [&](const Entry& entry) { return entry.node == node && entry.missed_last; });
}

}  // namespace lfd::controller
