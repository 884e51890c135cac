// Texture lookups by the rules of glTF samplers.
#include "bench/reference/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/log.h"

namespace lfd::reference {
namespace {

std::array<float, 256> decode_table() {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) table[i] = static_cast<float>(linear_from_srgb(i / 255.0));
  return table;
}

long wrapped(proto::Texture::Wrap wrap, long i, long size) {
  if (wrap == proto::Texture::CLAMP_TO_EDGE) return std::clamp(i, 0L, size - 1);
  const long period = wrap == proto::Texture::MIRRORED_REPEAT ? 2 * size : size;
  const long inside = ((i % period) + period) % period;
  return inside < size ? inside : period - 1 - inside;
}

}  // namespace

double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Result<Texture> Texture::make(const proto::Texture& description, const Picture8& picture) {
  LFD_CHECK(picture.width > 0 && picture.height > 0, "a picture has pixels");
  LFD_CHECK(picture.rgba.size() == std::size_t{4} * picture.width * picture.height, "RGBA of every pixel");
  Texture texture;
  texture.width_ = picture.width;
  texture.height_ = picture.height;
  static const std::array<float, 256> linear = decode_table();
  texture.linear_.resize(picture.rgba.size() / 4);
  for (std::size_t i = 0; i < texture.linear_.size(); ++i) {
    const std::uint8_t* from = &picture.rgba[4 * i];
    texture.linear_[i] = {linear[from[0]], linear[from[1]], linear[from[2]], from[3] / 255.0F};
  }
  texture.wrap_s_ = description.wrap_s();
  texture.wrap_t_ = description.wrap_t();
  texture.nearest_ = description.nearest();
  const auto& m = description.uv_transform();
  if (m.size() != 0 && m.size() != 6) return Error(fmt::format("uv_transform: {} numbers, 6 are needed", m.size()));
  if (m.size() == 6) {
    texture.u_row_ = {m[0], m[1], m[2]};
    texture.v_row_ = {m[3], m[4], m[5]};
  }
  return texture;
}

glm::dvec4 Texture::texel(long column, long row) const {
  const long x = wrapped(wrap_s_, column, width_), y = wrapped(wrap_t_, row, height_);
  return linear_[static_cast<std::size_t>(y) * width_ + x];
}

glm::dvec4 Texture::sample(glm::dvec2 uv) const {
  const glm::dvec3 homogeneous{uv, 1};
  const double x = glm::dot(u_row_, homogeneous) * width_, y = glm::dot(v_row_, homogeneous) * height_;
  // Coordinates that no texel index can hold (or NaN) have no colour of their own; the first texel stands for them.
  if (!(std::abs(x) < 1e15) || !(std::abs(y) < 1e15)) return texel(0, 0);
  if (nearest_) return texel(static_cast<long>(std::floor(x)), static_cast<long>(std::floor(y)));
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const double right_share = x - 0.5 - left, bottom_share = y - 0.5 - top;
  const long column = static_cast<long>(left), row = static_cast<long>(top);
  const glm::dvec4 upper = (1 - right_share) * texel(column, row) + right_share * texel(column + 1, row);
  const glm::dvec4 lower = (1 - right_share) * texel(column, row + 1) + right_share * texel(column + 1, row + 1);
  return (1 - bottom_share) * upper + bottom_share * lower;
}

}  // namespace lfd::reference
