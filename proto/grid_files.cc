// Grid files of all formats to and from messages.
#include "proto/grid_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "base/file.h"
#include "base/log.h"
#include "calibration/import/pfm.h"
#include "proto/grid_csv.h"
#include "proto/pictures/exr.h"

namespace lfd {
namespace {

namespace fs = std::filesystem;

// A grid of pixels of `channels` numbers each; a hole is one where either coordinate is NaN.
Result<GridNodes> nodes_of(int width, int height, const std::vector<float>& numbers, std::size_t channels) {
  GridNodes nodes;
  nodes.columns = width;
  nodes.rows = height;
  nodes.node.reserve(numbers.size() / channels);
  for (std::size_t i = 0; i < numbers.size(); i += channels) {
    const ScreenPoint s{numbers[i], numbers[i + 1]};
    const double hole = s.x + s.y;
    nodes.node.push_back(std::isnan(s.x) || std::isnan(s.y) ? ScreenPoint{hole, hole} : s);
  }
  if (const auto fault = node_fault(nodes)) {
    return Error(fmt::format("pixel ({}, {}): {}: {}", fault->column, fault->row, fault->coordinate, fault->what));
  }
  return nodes;
}

Result<GridNodes> parse_grid_pfm(std::string_view content) {
  LFD_TRY(const PfmPixels pixels, parse_pfm(content, kMaxGridSide));
  return nodes_of(pixels.width, pixels.height, pixels.numbers, 3);
}

Result<GridNodes> parse_grid_exr(std::string_view content) {
  LFD_TRY(const auto channels, exr_channels(content, kMaxGridSide));
  const bool is_named = std::ranges::count(channels, "s") > 0;
  const std::array<std::string, 4> names{is_named ? "s" : "R", is_named ? "y" : "G", "", ""};
  LFD_TRY(const PictureF picture, decode_exr_channels(content, names, kMaxGridSide));
  return nodes_of(picture.width, picture.height, picture.rgba, 4);
}

Status check_path(const fs::path& path) {
  if (path.is_absolute()) return Error("the path must be relative to the calibration file");
  if (std::ranges::count(path, fs::path("..")) > 0) return Error("the path leaves the calibration file's folder");
  return {};
}

Result<GridNodes> load_nodes(const std::string& name, const fs::path& folder) {
  LFD_TRY_STATUS(check_path(name));
  // The reader's own message has the whole path; the caller has said which file it is.
  LFD_TRY(const std::string content, read_file(folder / name, kGridFileLimit_bytes));
  return parse_grid_file(name, content);
}

Status fill(proto::Grid& grid, const GridNodes& nodes) {
  if (grid.s_size() > 0 || grid.y_size() > 0) return Error("nodes are here and in a file; one of both is possible");
  for (const auto& [name, said, found] :
       {std::tuple{"columns", grid.columns(), nodes.columns}, std::tuple{"rows", grid.rows(), nodes.rows}}) {
    if (said != 0 && said != found) return Error(fmt::format("{}: {}, but the file has {}", name, said, found));
  }
  grid.set_columns(nodes.columns);
  grid.set_rows(nodes.rows);
  const auto count = static_cast<int>(nodes.node.size());
  grid.mutable_s()->Reserve(count);
  grid.mutable_y()->Reserve(count);
  for (const ScreenPoint& s : nodes.node) {
    grid.add_s(s.x);
    grid.add_y(s.y);
  }
  grid.clear_file();
  return {};
}

std::string print_grid_pfm(const GridNodes& nodes) {
  PfmPixels pixels{nodes.columns, nodes.rows, {}};
  pixels.numbers.reserve(3 * nodes.node.size());
  for (const ScreenPoint& s : nodes.node) {
    pixels.numbers.insert(pixels.numbers.end(), {static_cast<float>(s.x), static_cast<float>(s.y), 0.0F});
  }
  return print_pfm(pixels);
}

}  // namespace

Result<GridNodes> parse_grid_file(std::string_view name, std::string_view content) {
  if (name.ends_with(".pfm")) return parse_grid_pfm(content);
  if (name.ends_with(".exr")) return parse_grid_exr(content);
  if (name.ends_with(".csv")) return parse_grid_csv(content);
  return Error("its name must end in .pfm, .exr or .csv");
}

Status read_grid_files(proto::DisplayCalibration& message, const fs::path& folder) {
  std::size_t nodes_left = kMaxFileNodes;
  for (int k = 0; k < message.module_size(); ++k) {
    if (!message.module(k).has_grid() || message.module(k).grid().file().empty()) continue;
    proto::Grid& grid = *message.mutable_module(k)->mutable_grid();
    const std::string name = grid.file(), road = fmt::format("module {}: grid: file: {}", k, name);
    const auto nodes = load_nodes(name, folder);
    if (!nodes) return nodes.error().within(road);
    if (nodes->node.size() > nodes_left) {
      return Error(fmt::format("{}: the grids have more than {} nodes in all", road, kMaxFileNodes));
    }
    nodes_left -= nodes->node.size();
    if (auto status = fill(grid, *nodes); !status) return status.error().within(road);
  }
  return {};
}

Status write_grid_files(proto::DisplayCalibration& message, const fs::path& folder, const std::string& stem,
                        GridFileFormat format) {
  for (int k = 0; k < message.module_size(); ++k) {
    if (!message.module(k).has_grid()) continue;
    proto::Grid& grid = *message.mutable_module(k)->mutable_grid();
    GridNodes nodes;
    nodes.columns = grid.columns();
    nodes.rows = grid.rows();
    for (int i = 0; i < grid.s_size(); ++i) nodes.node.push_back({grid.s(i), grid.y(i)});
    const bool is_pfm = format == GridFileFormat::kPfm;
    const std::string name = fmt::format("{}-module-{:03}.{}", stem, k, is_pfm ? "pfm" : "csv");
    LFD_TRY_STATUS(write_file(folder / name, is_pfm ? print_grid_pfm(nodes) : print_grid_csv(nodes)));
    grid.set_file(name);
    grid.clear_s();
    grid.clear_y();
  }
  return {};
}

}  // namespace lfd
