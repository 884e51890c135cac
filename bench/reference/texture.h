// A base colour texture as the reference reads it: level 0, filtered in double precision on linear light.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "base/result.h"
#include "proto/pictures/picture.h"
#include "proto/scene.pb.h"

namespace lfd::reference {

// The sRGB transfer function of IEC 61966-2-1, both ways, on [0, 1].
double linear_from_srgb(double encoded);
double srgb_from_linear(double linear);

class Texture {
 public:
  // `picture` has at least one pixel. Errors: a uv transform that is not 0 or 6 numbers.
  static Result<Texture> make(const proto::Texture& description, const Picture8& picture);

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
