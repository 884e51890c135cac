// A base colour texture as the reference reads it: level 0, filtered in double precision on linear light.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "proto/scene.pb.h"

namespace lfd::reference {

// A decoded picture: RGBA, 8 bits, colour sRGB-encoded, alpha linear, rows from the top; rgba.size() = 4 width height.
struct RgbaPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

// Decodes a PNG or JPEG file given as bytes.
using PictureDecoder = std::function<Result<RgbaPicture>(std::string_view file)>;

// The sRGB transfer function of IEC 61966-2-1, both ways, on [0, 1].
double linear_from_srgb(double encoded);
double srgb_from_linear(double linear);

class Texture {
 public:
  // `picture` has at least one pixel. Errors: a uv transform that is not 0 or 6 numbers.
  static Result<Texture> make(const proto::Texture& description, const RgbaPicture& picture);

  // Linear colour and alpha at mesh coordinates (u, v); v grows downward from the picture's top row, as in glTF.
  glm::dvec4 sample(glm::dvec2 uv) const;

 private:
  Texture() = default;
  glm::dvec4 texel(long column, long row) const;

  int width_ = 0, height_ = 0;
  std::vector<glm::vec4> linear_;
  proto::Texture::Wrap wrap_s_ = proto::Texture::REPEAT, wrap_t_ = proto::Texture::REPEAT;
  bool nearest_ = false;
  glm::dvec3 u_row_{1, 0, 0}, v_row_{0, 1, 0};
};

}  // namespace lfd::reference
