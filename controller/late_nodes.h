// Who misses deadlines, and what the log says of it: a few lines, however many frames a node is late in.
#pragma once

#include <string>
#include <vector>

#include "base/clock.h"

namespace lfd::controller {

class LateNodes {
 public:
  // A node that was late counts as in time again once it has been for so long.
  static constexpr Clock::duration kSure = std::chrono::seconds(2);

  struct News {
    std::string node;
    bool is_late = false;  // else it is in time again
  };

  // A frame was swapped at its deadline without these nodes, or in time. Returns whom there is something new to say of.
  std::vector<News> swapped(const std::vector<std::string>& missing, Clock::time_point now);

  // It is out, which is said elsewhere.
  void gone(const std::string& node);

  // Whether the last frame swapped waited for it in vain.
  bool is_late(const std::string& node) const;

 private:
  struct Entry {
    std::string node;
    Clock::time_point last_late;
    bool missed_last = false;  // frame
  };
  std::vector<Entry> entries_;
};

}  // namespace lfd::controller
