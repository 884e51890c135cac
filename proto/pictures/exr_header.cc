// Attribute by attribute: name, type, size, bytes; numbers are little-endian, and so are our machines.
#include "proto/pictures/exr_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <utility>

#include "base/log.h"
#include "proto/pictures/picture.h"

namespace lfd {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kTiled = 0x200, kDeep = 0x800, kManyParts = 0x1000;
constexpr std::size_t kLongestName = 255, kChannelNumbers_bytes = 16;

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view bytes) : rest_(bytes) {}

  std::optional<std::string_view> bytes(std::size_t count) {
    if (count > rest_.size()) return std::nullopt;
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  bool is_at_end() const { return rest_.empty(); }

  // Up to the next zero byte.
  std::optional<std::string_view> name() {
    const std::size_t end = rest_.substr(0, kLongestName + 1).find('\0');
    if (end == rest_.npos) return std::nullopt;
    const auto taken = bytes(end);
    rest_.remove_prefix(1);
    return taken;
  }

  template <class T>
  std::optional<T> number() {
    const auto taken = bytes(sizeof(T));
    if (!taken) return std::nullopt;
    T value;
    std::memcpy(&value, taken->data(), sizeof value);
    return value;
  }

 private:
  std::string_view rest_;
};

Error too_short() { return Error("EXR: the file ends too early"); }

Status check_window(std::string_view value, int most_side) {
  std::array<std::int32_t, 4> box;  // least x and y, most x and y
  if (value.size() != sizeof box) return Error("EXR: dataWindow: is no box of whole numbers");
  std::memcpy(box.data(), value.data(), sizeof box);
  const std::int64_t width = std::int64_t{box[2]} - box[0] + 1, height = std::int64_t{box[3]} - box[1] + 1;
  if (width >= 1 && height >= 1 && width <= most_side && height <= most_side &&
      static_cast<std::size_t>(width * height) <= kMaxPicturePixels)
    return {};
  return Error(fmt::format("EXR: {} x {} pixels; at most {} are read, at most {} a side", width, height,
                           kMaxPicturePixels, most_side));
}

Status check_channels(std::string_view value) {
  HeaderReader reader(value);
  for (int count = 0;; ++count) {
    const auto name = reader.name();
    if (!name) return Error("EXR: channels: the list does not end");
    if (name->empty()) return reader.is_at_end() ? Status() : Error("EXR: channels: the list ends before its size");
    if (count == kMostExrChannels) return Error(fmt::format("EXR: channels: more than {}", kMostExrChannels));
    if (!reader.bytes(kChannelNumbers_bytes)) return Error("EXR: channels: the list does not end");
  }
}

// OpenEXR reads most types without a look at the size that stands before them, and takes what follows for the next
// attribute; of pictures and texts it takes memory by numbers in the value.
constexpr std::pair<std::string_view, std::size_t> kSizes[] = {
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
};

bool is_preview(std::string_view value) {
  HeaderReader reader(value);
  const auto width = reader.number<std::uint32_t>(), height = reader.number<std::uint32_t>();
  return width && height && std::uint64_t{*width} * *height * 4 == value.size() - 8 && *width <= value.size() &&
         *height <= value.size();
}

bool is_string_list(std::string_view value) {
  HeaderReader reader(value);
  while (!reader.is_at_end()) {
    const auto length = reader.number<std::uint32_t>();
    if (!length || !reader.bytes(*length)) return false;
  }
  return true;
}

Status check_value(std::string_view name, std::string_view type, std::string_view value) {
  if (type == "chlist") return check_channels(value);
  const auto known = std::ranges::find(kSizes, type, &std::pair<std::string_view, std::size_t>::first);
  const bool fits = known != std::end(kSizes) ? value.size() == known->second
                    : type == "preview"       ? is_preview(value)
                    : type == "stringvector"  ? is_string_list(value)
                    : type == "floatvector"   ? value.size() % 4 == 0
                                              : true;  // as many bytes as its size says
  if (fits) return {};
  return Error(fmt::format("EXR: attribute {}: {} bytes are no {}", name, value.size(), type));
}

}  // namespace

Status check_exr_header(std::string_view file, int most_side) {
  HeaderReader reader(file);
  const auto magic = reader.number<std::uint32_t>(), version = reader.number<std::uint32_t>();
  if (!magic || !version) return too_short();
  if (*magic != kMagic) return Error("EXR: is no OpenEXR file");
  if ((*version & (kTiled | kDeep | kManyParts)) != 0) return Error("EXR: only one picture of scanlines is read");
  bool has_window = false;
  for (;;) {
    const auto name = reader.name();
    if (!name) return too_short();
    if (name->empty()) break;
    const auto type = reader.name();
    const auto size = reader.number<std::uint32_t>();
    if (!type || !size) return too_short();
    const auto value = reader.bytes(*size);
    if (!value) return Error(fmt::format("EXR: attribute {}: {} bytes, but the file ends before", *name, *size));
    if (*name == "dataWindow") {
      LFD_TRY_STATUS(check_window(*value, most_side));
      has_window = true;
    }
    LFD_TRY_STATUS(check_value(*name, *type, *value));
  }
  if (!has_window) return Error("EXR: no dataWindow");
  return {};
}

}  // namespace lfd
