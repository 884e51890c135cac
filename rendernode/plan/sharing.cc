// Neighbours by their emitters.
#include "rendernode/plan/sharing.h"

#include <algorithm>
#include <numeric>

namespace lfd {

bool Sharing::has_neighbours() const {
  return std::ranges::any_of(window, [](const Window& one) { return one.first < one.last; });
}

Sharing share_among(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules,
                    const std::vector<bool>& is_drawn, int each_side) {
  const int count = static_cast<int>(modules.size());
  std::vector<std::uint32_t> order(modules.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t layer) { return display.modules[modules[layer]].emitter.x; });
  Sharing sharing;
  sharing.parts = 2 * each_side + 1;
  sharing.window.resize(modules.size());
  sharing.part.resize(modules.size());
  std::vector<std::uint32_t> drawn_before{0};  // how many of the first i modules of the order are drawn
  for (int i = 0; i < count; ++i) {
    const std::uint32_t layer = order[static_cast<std::size_t>(i)];
    sharing.part[layer] = i % sharing.parts;
    if (is_drawn[layer]) sharing.layer_of_rank.push_back(layer);
    drawn_before.push_back(static_cast<std::uint32_t>(sharing.layer_of_rank.size()));
  }
  for (int i = 0; i < count; ++i) {
    const std::uint32_t layer = order[static_cast<std::size_t>(i)];
    if (!is_drawn[layer]) continue;
    const auto before = static_cast<std::size_t>(std::max(0, i - each_side));
    const auto end = static_cast<std::size_t>(std::min(count, i + each_side + 1));
    sharing.window[layer] = {drawn_before[before], drawn_before[end] - 1};
  }
  return sharing;
}

}  // namespace lfd
