// Render targets.
#include "rendernode/passes/targets.h"

#include <array>

#include "base/log.h"
#include "rendernode/gl/memory.h"

namespace lfd {

Status Targets::prepare(const FramePlan& plan) {
  Status made = make(plan);
  if (!made) *this = Targets(size_, layers_);
  return made;
}

Status Targets::make(const FramePlan& plan) {
  if (plan.pyramid_levels > 0)
    LFD_TRY_STATUS(pyramid_.prepare(plan.pyramid_factor, plan.pyramid_levels, size_, layers_));
  if (!make_textures(plan) && geometry(plan) != 0) return {};
  return make_framebuffers(plan,
                           fmt::format("the pictures of {} modules of {}x{}", layers_, size_.width, size_.height));
}

bool Targets::make_textures(const FramePlan& plan) {
  bool made = false;
  const auto make_of = [&](gl::Texture& texture, GLenum format, ImageSize size) {
    if (texture) return;
    texture = gl::make_array_texture(format, size, layers_);
    made = true;
  };
  const auto make = [&](gl::Texture& texture, GLenum format) { make_of(texture, format, size_); };
  make(albedo_, GL_SRGB8_ALPHA8);
  make(depth_, GL_DEPTH_COMPONENT32F);
  if (plan.position) make(position_, GL_RGBA32F);
  if (plan.normal) make(normal_, GL_RGBA16F);
  if (plan.ao && plan.bent != bent_) drop_ao(plan.bent);
  const GLenum ao_format = bent_ ? GL_RGBA16F : GL_R16F;
  if (plan.ao) make(ao_[0], ao_format);
  if (plan.upsample) make_of(half_ao_, ao_format, half_size());
  if (plan.ao && (plan.blur || plan.share)) make(ao_[1], ao_format);
  if (plan.post) make(color_, GL_SRGB8_ALPHA8);
  return made;
}

void Targets::drop_ao(bool bent) {
  for (gl::Texture* texture : {&ao_[0], &ao_[1], &half_ao_}) *texture = {};
  for (gl::Framebuffer* framebuffer : {&ao_framebuffer_[0], &ao_framebuffer_[1], &half_ao_framebuffer_})
    *framebuffer = {};
  bent_ = bent;
}

Status Targets::make_framebuffers(const FramePlan& plan, std::string_view what) {
  LFD_TRY_STATUS(gl::memory_status(what));
  const auto make = [&](gl::Framebuffer& framebuffer, const gl::Texture& color, GLuint depth) -> Status {
    if (framebuffer || !color) return {};
    const std::array<GLuint, 1> colors{color.name()};
    LFD_TRY(framebuffer, gl::make_layered_framebuffer(colors, depth, what));
    return {};
  };
  if (!depth_framebuffer_) {
    LFD_TRY(depth_framebuffer_, gl::make_layered_framebuffer({}, depth_.name(), what));
  }
  LFD_TRY_STATUS(make(ao_framebuffer_[0], ao_[0], depth_.name()));
  LFD_TRY_STATUS(make(ao_framebuffer_[1], ao_[1], depth_.name()));
  LFD_TRY_STATUS(make(half_ao_framebuffer_, half_ao_, 0));
  LFD_TRY_STATUS(make(color_framebuffer_, color_, 0));
  gl::Framebuffer& geometry_framebuffer = geometry_framebuffer_[plan.position ? 1 : 0][plan.normal ? 1 : 0];
  if (geometry_framebuffer) return {};
  const std::array<GLuint, 3> colors{albedo_.name(), plan.position ? position_.name() : 0,
                                     plan.normal ? normal_.name() : 0};
  LFD_TRY(geometry_framebuffer, gl::make_layered_framebuffer(colors, depth_.name(), what));
  return {};
}

}  // namespace lfd
