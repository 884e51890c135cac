// What a scene contains, counted.
#include <set>
#include <string>
#include <unordered_map>

#include "base/log.h"
#include "controller/scene/scene_file.h"
#include "proto/mesh_arrays.h"

namespace lfd::scene {

Result<Census> census_of(const SceneData& data) {
  Census census;
  std::unordered_map<std::string, std::size_t> faces;  // by mesh
  for (const proto::Instance& instance : data.scene.instance()) {
    if (!faces.contains(instance.mesh())) {
      const auto asset = data.assets.find(instance.mesh());
      if (asset == data.assets.end()) return Error(fmt::format("mesh {} is missing", instance.mesh()));
      LFD_TRY(const MeshArrays arrays, mesh_arrays(*asset->second));
      faces[instance.mesh()] = arrays.index.size() / 3;
    }
    census.faces += faces[instance.mesh()];
  }
  std::set<std::string> pictures;
  for (const proto::Material& material : data.scene.material()) {
    if (material.has_texture()) pictures.insert(material.texture().picture());
  }
  census.meshes = faces.size();
  census.pictures = pictures.size();
  return census;
}

}  // namespace lfd::scene
