// Bad numbers in the files of measured grids, read with the calibration that they lie beside.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "bench/stability/file_fields.h"
#include "bench/stability/groups.h"
#include "bench/stability/harmless.h"
#include "calibration/import/pfm.h"
#include "proto/calibration_file.h"
#include "proto/pictures/exr.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "fields of grid files";

// The grid stands on the fifth line.
std::string display_with(const std::string& file) {
  return fmt::format(
      "screen {{ width_m: 2.4 height_m: 1.4 }}\n"
      "image {{ width_px: 40 height_px: 30 }}\n"
      "optics {{ diffuser: LINEAR observer_distance_m: 3 }}\n"
      "angular_scattering_rad: 0.1\n"
      "module {{ emitter {{ z: -1 }} grid {{ file: \"{}\" first_u_px: 5 first_v_px: 5 step_u_px: 10 step_v_px: 10 }} "
      "}}\n",
      file);
}

// 4 x 3 nodes.
constexpr const char* kCsv =
    "column,row,s,y\n"
    "0,0,-1.1,0.6\n"
    "1,0,-0.35,0.62\n"
    "2,0,0.4,0.61\n"
    "3,0,1.15,0.63\n"
    "0,1,-1.12,0.02\n"
    "1,1,-0.36,0.01\n"
    "2,1,0.41,-0.01\n"
    "3,1,1.1,-0.03\n"
    "0,2,-1.05,-0.6\n"
    "1,2,-0.33,-0.58\n"
    "2,2,0.38,-0.61\n"
    "3,2,1.2,-0.62\n";
constexpr std::size_t kSpoiltNode = 5;  // column 1, row 1: without it two cells are left

std::string beginning_of(const std::string& file) {
  return fmt::format("display.textproto:5: module 0: grid: file: {}: ", file);
}

// The error as it would be if the file were in the working folder.
Error without_folder(const Error& error, const std::filesystem::path& folder) {
  const std::string road = folder.string() + "/";
  const std::string& message = error.message();
  return Error(message.starts_with(road) ? message.substr(road.size()) : message);
}

Result<std::string> harm_of_file(const std::string& file, const std::string& content) {
  LFD_TRY(const TemporaryFolder folder, TemporaryFolder::make("lfd-stability"));
  LFD_TRY_STATUS(write_file(folder.path() / "display.textproto", display_with(file)));
  LFD_TRY_STATUS(write_file(folder.path() / file, content));
  const auto display = load_calibration(folder.path() / "display.textproto");
  if (!display) return without_folder(display.error(), folder.path());
  return harm_of(*display);
}

// `before`: what of kCsv stands before the field.
StabilityCase csv_case(const std::string& field, const std::string& before, char end) {
  const TextSlot slot = slot_of(kCsv, before, end);
  return field_case(kGroup, {"CSV: " + field,
                             slot.sound,
                             {kBadTexts.begin(), kBadTexts.end()},
                             {field},
                             fmt::format("{}{}: ", beginning_of("g.csv"), slot.line()),
                             [slot](const std::string& value) { return harm_of_file("g.csv", slot.with(value)); }});
}

const GridNodes& sound_nodes() {
  static const GridNodes kNodes = [] {
    auto nodes = parse_grid_file("g.csv", kCsv);
    LFD_CHECK(nodes, nodes.error().message());
    return *std::move(nodes);
  }();
  return kNodes;
}

// The nodes as pixels of so many channels; number `channel` of the spoilt node is `value`.
std::vector<float> numbers_with(std::size_t channels, std::size_t channel, const std::string& value) {
  std::vector<float> numbers;
  for (const ScreenPoint& s : sound_nodes().node) {
    const std::size_t begin = numbers.size();
    numbers.insert(numbers.end(), {static_cast<float>(s.x), static_cast<float>(s.y)});
    numbers.resize(begin + channels);
  }
  numbers[channels * kSpoiltNode + channel] = std::strtof(value.c_str(), nullptr);
  return numbers;
}

Result<std::string> harm_of_pfm(std::size_t channel, const std::string& value) {
  return harm_of_file("g.pfm", print_pfm({sound_nodes().columns, sound_nodes().rows, numbers_with(3, channel, value)}));
}

Result<std::string> harm_of_exr(std::size_t channel, const std::string& value) {
  LFD_TRY(const std::string content,
          encode_exr({sound_nodes().columns, sound_nodes().rows, numbers_with(4, channel, value)}));
  return harm_of_file("g.exr", content);
}

using ReadPixel = Result<std::string> (*)(std::size_t channel, const std::string& value);

StabilityCase pixel_case(const std::string& format, const std::string& file, std::size_t channel, ReadPixel read) {
  const ScreenPoint& sound = sound_nodes().node[kSpoiltNode];
  const std::string coordinate = channel == 0 ? "s" : "y";
  return field_case(kGroup, {format + ": " + coordinate,
                             fmt::format("{}", static_cast<float>(channel == 0 ? sound.x : sound.y)),
                             {kBadFloats.begin(), kBadFloats.end()},
                             {coordinate},
                             beginning_of(file) + "pixel (1, 1): ",
                             [channel, read](const std::string& value) { return read(channel, value); }});
}

// Of the header. A scale that is none of a header's makes numbers that are no places, and they are named; a side that
// is left out is the next number.
StabilityCase pfm_header_case(const std::string& field, const std::string& before, char end,
                              const std::vector<std::string>& words) {
  const TextSlot slot =
      slot_of(print_pfm({sound_nodes().columns, sound_nodes().rows, numbers_with(3, 2, "0")}), before, end);
  std::vector<std::string> bad(kBadTexts.begin(), kBadTexts.end());
  bad.insert(bad.end(), {"-1e39", "-1e-12", "-1e-40", "-4.9e-324"});
  return field_case(kGroup, {"PFM: " + field, slot.sound, bad, words, beginning_of("g.pfm"),
                             [slot](const std::string& value) { return harm_of_file("g.pfm", slot.with(value)); }});
}

}  // namespace

void add_grid_file_field_cases(StabilityCases& cases) {
  const std::string lines_before = "0,1,-1.12,0.02\n";
  cases.push_back(csv_case("column", lines_before, ','));
  cases.push_back(csv_case("row", lines_before + "1,", ','));
  cases.push_back(csv_case("s", lines_before + "1,1,", ','));
  cases.push_back(csv_case("y", lines_before + "1,1,-0.36,", '\n'));
  for (const std::size_t channel : {0, 1}) {
    cases.push_back(pixel_case("PFM", "g.pfm", channel, harm_of_pfm));
    cases.push_back(pixel_case("EXR", "g.exr", channel, harm_of_exr));
  }
  cases.push_back(pfm_header_case("width", "PF\n", ' ', {"PFM: width", "PFM: height"}));
  cases.push_back(pfm_header_case("height", "PF\n4 ", '\n', {"PFM: height"}));
  cases.push_back(pfm_header_case("scale", "PF\n4 3\n", '\n', {"PFM: scale", "s", "y"}));
}

}  // namespace lfd::bench
