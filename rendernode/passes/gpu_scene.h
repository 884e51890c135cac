// A scene as the GPU knows it: triangles, planes, materials, textures and lights.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "proto/pictures/picture.h"
#include "proto/scene_data.h"
#include "rendernode/geometry/physical_geometry.h"
#include "rendernode/gl/objects.h"
#include "rendernode/plan/frame_plan.h"

namespace lfd {

// Pictures of one size and one way to be sampled, as the layers of one array texture.
struct TextureGroup {
  gl::Texture texture;
  gl::Sampler sampler;
};

// Materials and the textures they use. Changes only when the scene's materials do.
struct GpuMaterials {
  gl::Buffer params;  // std430 array of MaterialParams
  std::vector<TextureGroup> groups;
  std::vector<MaterialFacts> facts;  // per material, for the planner
};

// Errors name the material and what is wrong with its picture; `unlit` makes every material unlit.
Result<GpuMaterials> upload_materials(const proto::Scene& scene, const Assets& assets, bool unlit);

// Triangles in physical space. Changes with the region of interest and with moving instances.
struct GpuGeometry {
  gl::Buffer vertices, indices, planes;
  gl::Texture plane_texels;  // the planes, one texel for each of their vectors
};

// What fits into the texels of the planes.
std::size_t most_triangles();

GpuGeometry upload_geometry(const PhysicalGeometry& geometry);

struct GpuLights {
  gl::Buffer params;  // std430 array of LightParams
  int count = 0;
  LightFacts facts;
};

// Positions are counted from the ROI centre. HEAD lights shine along physical -z.
GpuLights upload_lights(const proto::Scene& scene, const RegionOfInterest& roi);

}  // namespace lfd
