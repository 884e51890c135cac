// Decides which modules of a node share their ambient occlusion: those whose emitters stand next to each other.
#pragma once

#include <cstdint>
#include <vector>

#include "calibration/display.h"

namespace lfd {

// Modules stand in the order of their emitters, from left to right. Layers that are not drawn share nothing: their
// pictures are old.
struct Sharing {
  // One layer's neighbours by their ranks in layer_of_rank, itself among them; none where first > last.
  struct Window {
    std::uint32_t first = 1, last = 0;
    bool operator==(const Window&) const = default;
  };

  int parts = 1;                             // of the samples; neighbours as far as they go have different ones
  std::vector<std::uint32_t> layer_of_rank;  // of all layers that share
  std::vector<Window> window;                // of each layer of the node
  std::vector<int> part;                     // of each layer, 0 to parts - 1
  bool operator==(const Sharing&) const = default;

  bool has_neighbours() const;
};

// `modules` are the numbers of the node's modules, one a layer; `is_drawn` tells of each layer. `each_side` modules to
// the left and to the right of one are its neighbours, as many as the node has of them there, less those not drawn: a
// module that sees nothing leaves a hole, and nobody further away takes its place.
Sharing share_among(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules,
                    const std::vector<bool>& is_drawn, int each_side);

}  // namespace lfd
