// Textures computed texel by texel, encoded as PNG.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>

namespace lfd::scene {

// The colour at (u, v) in [0, 1)^2, v pointing down: r g b in [0, 1] as stored (sRGB).
using Painter = std::function<glm::dvec3(double u, double v)>;

// An 8-bit RGB PNG file, painted at the texels' centres.
std::string painted_png(int width_px, int height_px, const Painter& paint);

}  // namespace lfd::scene
