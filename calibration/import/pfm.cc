// PFM files to and from numbers.
#include "calibration/import/pfm.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/log.h"

namespace lfd {
namespace {

constexpr std::string_view kWhite = " \t\r\n";

struct Header {
  int width = 0, height = 0;
  double scale = 1;
  std::size_t size = 0;  // bytes
};

// Takes the next word off `rest`.
std::string_view next_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(kWhite), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(kWhite));
  rest.remove_prefix(word.size());
  return word;
}

template <class Number>
Result<Number> next_number(std::string_view& rest, const char* name) {
  const std::string_view word = next_word(rest);
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  Number number{};
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (failure != std::errc() || end != digits.data() + digits.size()) {
    return Error(fmt::format("PFM: {}: a number is needed", name));
  }
  return number;
}

Result<Header> parse_header(std::string_view file, int most_side) {
  if (file.starts_with("Pf")) return Error("PFM: one channel (Pf); three are needed (PF)");
  if (file.starts_with("PF4")) return Error("PFM: four channels (PF4); three are needed (PF)");
  std::string_view rest = file;
  if (next_word(rest) != "PF" || !file.starts_with("PF")) return Error("PFM: does not begin with PF");
  Header header;
  LFD_TRY(header.width, next_number<int>(rest, "width"));
  LFD_TRY(header.height, next_number<int>(rest, "height"));
  for (const auto& [name, side] : {std::pair{"width", header.width}, std::pair{"height", header.height}}) {
    if (side < 1 || side > most_side) return Error(fmt::format("PFM: {}: {}; 1 to {} are read", name, side, most_side));
  }
  LFD_TRY(header.scale, next_number<double>(rest, "scale"));
  if (header.scale == 0 || !std::isfinite(header.scale)) {
    return Error(fmt::format("PFM: scale: {}; it must be finite and not 0", header.scale));
  }
  if (rest.empty()) return Error("PFM: ends after the header");
  header.size = file.size() - rest.size() + 1;
  return header;
}

float number_at(const char* bytes, bool low_byte_first) {
  std::uint32_t word = 0;
  for (int i = 0; i < 4; ++i) {
    word |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * (low_byte_first ? i : 3 - i));
  }
  return std::bit_cast<float>(word);
}

}  // namespace

Result<PfmPixels> parse_pfm(std::string_view file, int most_side) {
  LFD_TRY(const Header header, parse_header(file, most_side));
  const std::string_view body = file.substr(header.size);
  const std::size_t row_numbers = 3 * static_cast<std::size_t>(header.width);
  const std::size_t numbers = row_numbers * static_cast<std::size_t>(header.height);
  if (body.size() != 4 * numbers) {
    return Error(fmt::format("PFM: {} bytes of pixels; {} x {} pixels need {}", body.size(), header.width,
                             header.height, 4 * numbers));
  }
  PfmPixels pixels{header.width, header.height, std::vector<float>(numbers)};
  const bool low_byte_first = header.scale < 0;
  const double scale = std::abs(header.scale);
  const char* bytes = body.data();
  for (int row = header.height - 1; row >= 0; --row) {
    float* to = pixels.at(0, row);
    for (std::size_t i = 0; i < row_numbers; ++i, bytes += 4) {
      to[i] = static_cast<float>(scale * static_cast<double>(number_at(bytes, low_byte_first)));
    }
  }
  return pixels;
}

std::string print_pfm(const PfmPixels& pixels) {
  std::string file = fmt::format("PF\n{} {}\n-1.0\n", pixels.width, pixels.height);
  file.reserve(file.size() + 4 * pixels.numbers.size());
  const std::size_t row_numbers = 3 * static_cast<std::size_t>(pixels.width);
  for (int row = pixels.height - 1; row >= 0; --row) {
    const float* from = pixels.at(0, row);
    for (std::size_t i = 0; i < row_numbers; ++i) {
      const auto word = std::bit_cast<std::uint32_t>(from[i]);
      for (int byte = 0; byte < 4; ++byte) file.push_back(static_cast<char>((word >> (8 * byte)) & 0xff));
    }
  }
  return file;
}

}  // namespace lfd
