// PFM files: three 32-bit floats a pixel, as measured grids and warps of projectors are exchanged.
//
// "PF", width, height and scale, parted by white space; one more white character; then the numbers. Rows run from the
// bottom. A negative scale means that the low byte comes first, a positive one the high byte. Its absolute value is
// what the numbers are multiplied by (P. Debevec's PFM description; most files have 1).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace lfd {

// Rows from the top, unlike the file's.
struct PfmPixels {
  int width = 0, height = 0;
  std::vector<float> numbers;  // 3 * width * height

  const float* at(int column, int row) const { return numbers.data() + index(column, row); }
  float* at(int column, int row) { return numbers.data() + index(column, row); }

 private:
  std::size_t index(int column, int row) const {
    return 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column));
  }
};

// Refuses other kinds (1-channel "Pf" by name), sides beyond `most_side`, a scale that is zero or not finite, and
// content that is shorter or longer than the header says. Takes memory for no more pixels than the file holds.
Result<PfmPixels> parse_pfm(std::string_view file, int most_side);

// The least significant byte first, scale 1: every float survives.
std::string print_pfm(const PfmPixels& pixels);

}  // namespace lfd
