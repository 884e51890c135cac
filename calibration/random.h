// Random numbers that are the same on every machine.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>

namespace lfd {

// Numbers from the raw bits of the generator: the standard's own distributions differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  // In [0, 1), evenly.
  double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

  // Nearly normal, mean 0, standard deviation 1, never beyond +-2.5: the sum of twelve uniform numbers.
  double normal() { return std::clamp(sum_of_twelve(), -2.5, 2.5); }

  // The same with its tails, which end at +-6.
  double normal_with_tails() { return sum_of_twelve(); }

 private:
  double sum_of_twelve() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += unit();
    return sum;
  }

  std::mt19937_64 bits_;
};

}  // namespace lfd
