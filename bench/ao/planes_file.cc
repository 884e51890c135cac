// A line of the key, one of the note, one of sizes, then the pictures.
#include "bench/ao/planes_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/file.h"
#include "base/log.h"
#include "calibration/display.h"

namespace lfd::bench {
namespace {

constexpr std::uint16_t kNoSurface = 65535;
constexpr float kMost = 65534;

std::uint16_t stored(float value) {
  return value < 0 ? kNoSurface : static_cast<std::uint16_t>(std::lround(std::min(value, 1.0F) * kMost));
}

float restored(std::uint16_t value) { return value == kNoSurface ? -1.0F : static_cast<float>(value) / kMost; }

// Up to the line's end, which is taken off too.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

std::vector<std::size_t> numbers_of(std::string_view line) {
  std::vector<std::size_t> numbers;
  const char* at = line.data();
  const char* const end = at + line.size();
  std::size_t number = 0;
  for (auto read = std::from_chars(at, end, number); read.ec == std::errc(); read = std::from_chars(at, end, number)) {
    numbers.push_back(number);
    at = read.ptr == end ? end : read.ptr + 1;
  }
  return numbers;
}

}  // namespace

Status write_planes(const std::filesystem::path& path, const Planes& planes) {
  const ImageSize size = planes.pictures.empty() ? ImageSize{} : planes.pictures.front().size;
  std::string text =
      fmt::format("{}\n{}\n{} {} {}\n", planes.key, planes.note, planes.pictures.size(), size.width, size.height);
  std::vector<std::uint16_t> numbers;
  for (const Openness& picture : planes.pictures) {
    for (const float value : picture.value) numbers.push_back(stored(value));
  }
  const std::size_t head = text.size();
  text.resize(head + numbers.size() * sizeof(std::uint16_t));
  if (!numbers.empty()) std::memcpy(text.data() + head, numbers.data(), numbers.size() * sizeof(std::uint16_t));
  LFD_TRY_STATUS(make_folder(path.parent_path()));
  return write_file(path, text);
}

std::optional<Planes> read_planes(const std::filesystem::path& path, const std::string& key) {
  const auto text = read_file(path);
  if (!text) return std::nullopt;
  std::string_view rest = *text;
  if (next_line(rest) != key) return std::nullopt;
  const std::string note(next_line(rest));
  const std::vector<std::size_t> sizes = numbers_of(next_line(rest));
  if (sizes.size() != 3 || sizes[1] > std::size_t{kMaxImageSide_px} || sizes[2] > std::size_t{kMaxImageSide_px})
    return std::nullopt;
  const std::size_t pixels = sizes[1] * sizes[2];
  if (pixels == 0 || rest.size() / sizeof(std::uint16_t) / pixels != sizes[0] ||
      rest.size() != sizes[0] * pixels * sizeof(std::uint16_t))
    return std::nullopt;
  Planes planes{key, note, {}};
  for (std::size_t i = 0; i < sizes[0]; ++i) {
    Openness picture{{static_cast<int>(sizes[1]), static_cast<int>(sizes[2])}, {}};
    picture.value.resize(pixels);
    for (float& value : picture.value) {
      std::uint16_t number = 0;
      std::memcpy(&number, rest.data(), sizeof(number));
      rest.remove_prefix(sizeof(number));
      value = restored(number);
    }
    planes.pictures.push_back(std::move(picture));
  }
  return planes;
}

}  // namespace lfd::bench
