// Numbers out of accessors: every claim of the file is checked before it is believed.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"

namespace lfd::scene::gltf {

// Values of an accessor as floats, `components` per element, tightly packed. Normalised integers become [0, 1] or [-1,
// 1]. Applies sparse values. Errors start with "accessor N: ".
Result<std::vector<float>> read_floats(const tinygltf::Model& model, int accessor, int components);

// The same with 4 or 3 components as the accessor has them (colours): the fourth is `fill` where the file has three.
Result<std::vector<float>> read_colors(const tinygltf::Model& model, int accessor, float fill);

// Values of a scalar accessor of unsigned integers.
Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int accessor);

// The bytes of a whole buffer view.
Result<std::span<const unsigned char>> bytes_of_view(const tinygltf::Model& model, int view);

}  // namespace lfd::scene::gltf
