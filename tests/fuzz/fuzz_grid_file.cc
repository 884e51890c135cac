// Fuzz target: grid files, of a format that the first byte chooses (p: PFM, c: CSV, e: EXR), are refused or have nodes.
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "base/check.h"
#include "proto/grid_csv.h"
#include "proto/grid_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const char* const name = data[0] == 'p' ? "g.pfm" : data[0] == 'c' ? "g.csv" : "g.exr";
  auto nodes = lfd::parse_grid_file(name, {reinterpret_cast<const char*>(data) + 1, size - 1});
  if (!nodes) return 0;
  LFD_CHECK(nodes->node.size() == static_cast<std::size_t>(nodes->columns) * static_cast<std::size_t>(nodes->rows),
            "as many nodes as columns and rows say");
  if (data[0] == 'c') {
    const auto copy = lfd::parse_grid_csv(lfd::print_grid_csv(*nodes));
    // Rows and columns of holes at the end cannot be written; files cannot give them either.
    LFD_CHECK(copy && *copy == *nodes, "the same nodes come back");
  }
  const auto map = lfd::GridMap::make(*std::move(nodes));
  if (map) (void)lfd::image_from_screen(*map, {0, 0});
  return 0;
}
