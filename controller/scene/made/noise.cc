// Seeded noise for textures.
#include "controller/scene/made/noise.h"

#include <cmath>

namespace lfd::scene {
namespace {

// splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

std::uint64_t wrapped(double cell, int cells) {
  const auto index = static_cast<std::int64_t>(cell) % cells;
  return static_cast<std::uint64_t>(index < 0 ? index + cells : index);
}

double smooth(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

double mixed(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

double random_unit(std::uint64_t seed, std::uint64_t x, std::uint64_t y) {
  return static_cast<double>(mix(mix(mix(seed) + x) + y) >> 11) * 0x1p-53;
}

double tiled_noise(std::uint64_t seed, double u, double v, int cells_u, int cells_v) {
  const double x = u * cells_u;
  const double y = v * cells_v;
  const auto value = [&](double dx, double dy) {
    return random_unit(seed, wrapped(std::floor(x) + dx, cells_u), wrapped(std::floor(y) + dy, cells_v));
  };
  const double tx = smooth(x - std::floor(x));
  const double ty = smooth(y - std::floor(y));
  return mixed(mixed(value(0, 0), value(1, 0), tx), mixed(value(0, 1), value(1, 1), tx), ty);
}

double tiled_octaves(std::uint64_t seed, double u, double v, int cells_u, int cells_v, int octaves) {
  double sum = 0;
  double weights = 0;
  double weight = 1;
  for (int octave = 0; octave < octaves; ++octave, weight /= 2) {
    const int scale = 1 << octave;
    const auto own_seed = seed + static_cast<std::uint64_t>(octave);
    sum += weight * tiled_noise(own_seed, u, v, cells_u * scale, cells_v * scale);
    weights += weight;
  }
  return sum / weights;
}

}  // namespace lfd::scene
