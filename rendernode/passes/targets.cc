// Render targets.
#include "rendernode/passes/targets.h"

#include <array>

namespace lfd {

void Targets::prepare(const FramePlan& plan) {
  const auto make = [this](gl::Texture& texture, GLenum format) {
    if (texture) return false;
    texture = gl::make_array_texture(format, size_, layers_);
    return true;
  };
  make(albedo_, GL_SRGB8_ALPHA8);
  if (make(depth_, GL_DEPTH_COMPONENT32F)) depth_framebuffer_ = gl::make_layered_framebuffer({}, depth_.name());
  if (plan.position) make(position_, GL_RGBA32F);
  if (plan.normal) make(normal_, GL_RGBA16F);
  for (int i = 0; plan.ao && i < (plan.blur ? 2 : 1); ++i) {
    if (!make(ao_[i], GL_R16F)) continue;
    const std::array<GLuint, 1> color{ao_[i].name()};
    ao_framebuffer_[i] = gl::make_layered_framebuffer(color, 0);
  }
  if (plan.post && make(color_, GL_SRGB8_ALPHA8)) {
    const std::array<GLuint, 1> color{color_.name()};
    color_framebuffer_ = gl::make_layered_framebuffer(color, 0);
  }
}

GLuint Targets::geometry(const FramePlan& plan) {
  gl::Framebuffer& framebuffer = geometry_framebuffer_[plan.position ? 1 : 0][plan.normal ? 1 : 0];
  if (!framebuffer) {
    const std::array<GLuint, 3> colors{albedo_.name(), plan.position ? position_.name() : 0, plan.normal ? normal_.name() : 0};
    framebuffer = gl::make_layered_framebuffer(colors, depth_.name());
  }
  return framebuffer.name();
}

}  // namespace lfd
