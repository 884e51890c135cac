// Seeded noise for textures: lattice values smoothly interpolated; it tiles.
#pragma once

#include <cstdint>

namespace lfd::scene {

// A number in [0, 1) that depends on nothing but its arguments.
double random_unit(std::uint64_t seed, std::uint64_t x, std::uint64_t y = 0);

// Smooth noise in [0, 1] over the unit square: `cells_u` x `cells_v` lattice cells; u and v repeat with period 1.
double tiled_noise(std::uint64_t seed, double u, double v, int cells_u, int cells_v);

// Octaves of tiled_noise, each with twice the cells and half the weight; in [0, 1].
double tiled_octaves(std::uint64_t seed, double u, double v, int cells_u, int cells_v, int octaves);

}  // namespace lfd::scene
