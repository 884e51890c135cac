// The list of made scenes.
#include "controller/scene/made/made_scenes.h"

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "controller/scene/made/recipes.h"

namespace lfd::scene {
namespace {

struct Entry {
  const char* name;
  const char* description;
  Recipe recipe;
};

constexpr Entry kEntries[] = {
    {"ribbed-shell", "a ribbed spiral shell of 29520 faces with image textures, on a floor before a wall",
     make_ribbed_shell},
    {"room", "twelve triangles facing inward: from outside one looks through the near wall", make_room},
    {"quad", "an unlit rectangle at z = 0 with a fine, smooth, band-limited texture", make_quad},
    {"depth-steps", "unlit textured rectangles at different depths before and behind z = 0", make_depth_steps},
    {"plane", "a plain white rectangle at z = 0", make_plane},
    {"wall", "a floor and a wall that meet at a right angle", make_wall},
    {"corner", "a floor and two walls that meet at right angles", make_corner},
};

}  // namespace

const std::vector<MadeScene>& made_scenes() {
  static const std::vector<MadeScene> scenes = [] {
    std::vector<MadeScene> list;
    for (const Entry& entry : kEntries) list.push_back({entry.name, entry.description});
    return list;
  }();
  return scenes;
}

Result<LoadedScene> make_scene(std::string_view name, std::uint64_t seed, Extent extent) {
  const auto* entry = std::ranges::find_if(kEntries, [&](const Entry& candidate) { return candidate.name == name; });
  if (entry == std::end(kEntries)) {
    std::vector<std::string> names;
    for (const MadeScene& scene : made_scenes()) names.push_back(scene.name);
    return Error(fmt::format("\"{}\" is not a made scene; there are {}", name, fmt::join(names, ", ")));
  }
  const bool sound = extent.width_m > 0 && extent.height_m > 0 && std::isfinite(extent.width_m * extent.height_m);
  if (!sound) return Error(fmt::format("extent: {} x {} m: both must be > 0", extent.width_m, extent.height_m));
  SceneBuilder scene{std::string(name)};
  LFD_TRY_STATUS(entry->recipe(seed, extent, scene));
  LoadedScene result;
  LFD_TRY(result.data, std::move(scene).finish());
  return result;
}

}  // namespace lfd::scene
