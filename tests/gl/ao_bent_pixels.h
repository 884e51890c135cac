// Bent normals as they are rendered, pixel by pixel.
#pragma once

#include <string>

#include "tests/gl/ao_scenes.h"

namespace lfd::testing_support {

// A pixel with a surface.
struct BentPixel {
  PixelIndex at;
  glm::dvec3 p, normal, bent;
};

inline glm::dvec3 three(const std::vector<float>& rgba, std::size_t i) { return {rgba[i], rgba[i + 1], rgba[i + 2]}; }

inline std::vector<BentPixel> bent_pixels_of(const FrameResult& result, ImageSize size) {
  const auto p = floats(result, proto::POSITION), n = floats(result, proto::NORMAL),
             bent = floats(result, proto::BENT_NORMAL);
  const glm::dvec3 origin = to_glm(result.position_origin);
  std::vector<BentPixel> pixels;
  for (std::size_t i = 0; i < p.size(); i += 4) {
    EXPECT_EQ(p[i + 3], bent[i + 3]) << "bent normals are where surfaces are";
    if (p[i + 3] == 0) continue;
    const int number = static_cast<int>(i / 4);
    pixels.push_back({{number % size.width, number / size.width}, three(p, i) + origin, three(n, i), three(bent, i)});
  }
  return pixels;
}

inline std::vector<BentPixel> draw_bent(AoStage& stage, const proto::AmbientOcclusion& ao) {
  return bent_pixels_of(stage.draw_buffers(ao, {proto::NORMAL, proto::BENT_NORMAL}), stage.display().image);
}

// Without blur.
inline proto::AmbientOcclusion bent_ao(const occlusion::Method& method, double radius_m) {
  proto::AmbientOcclusion ao;
  ao.set_method(std::string(method.name));
  ao.set_radius_m(radius_m);
  ao.set_bent_normals(true);
  ao.mutable_blur()->set_enabled(false);
  return ao;
}

}  // namespace lfd::testing_support
