// Scenes that the repository makes itself: the demo's and those with known answers for tests. The same seed, the same
// scene.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "controller/scene/loaded_scene.h"

namespace lfd::scene {

// The box that a made scene fills: centred at the origin in x and y.
struct Extent {
  double width_m = 1.6;   // along x
  double height_m = 0.9;  // along y
};

struct MadeScene {
  std::string name;
  std::string description;  // one sentence
};

const std::vector<MadeScene>& made_scenes();

// Refuses an unknown name (and lists the known ones) and an extent that is not positive. ribbed-shell has a size of its
// own.
Result<LoadedScene> make_scene(std::string_view name, std::uint64_t seed, Extent extent = {});

}  // namespace lfd::scene
