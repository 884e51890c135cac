// What a scene may at most contain; a file that claims more is refused before anything is allocated for it.
#pragma once

#include <cstddef>

namespace lfd::scene {

inline constexpr std::size_t kMaxVertices = std::size_t{64} << 20;  // of all meshes together
inline constexpr std::size_t kMaxIndices = 3 * kMaxVertices;        // of all meshes together
inline constexpr std::size_t kMaxInstances = std::size_t{1} << 20;
inline constexpr std::size_t kMaxPlacedVertices = std::size_t{512} << 20;  // vertices of each instance, summed
inline constexpr std::size_t kMaxMeshBytes = std::size_t{1} << 30;  // of one serialised mesh (Protobuf ends at 2 GiB)
inline constexpr std::size_t kMaxPictureBytes = std::size_t{256} << 20;  // of one encoded image
inline constexpr std::size_t kMaxNesting = 64;                           // of brackets in the JSON text

}  // namespace lfd::scene
