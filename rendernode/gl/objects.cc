// Making GL objects.
#include "rendernode/gl/objects.h"

#include <algorithm>

#include "base/log.h"

namespace lfd::gl {

Framebuffer make_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return Framebuffer(name);
}

VertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}

Query make_query(GLenum target) {
  GLuint name = 0;
  glCreateQueries(target, 1, &name);
  return Query(name);
}

Texture make_array_texture(GLenum internal_format, ImageSize size, int layers, int levels) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
  glTextureStorage3D(name, levels, internal_format, size.width, size.height, layers);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, levels > 1 ? GL_LINEAR : GL_NEAREST);
  return Texture(name);
}

Texture make_buffer_texture(GLenum internal_format, const Buffer& buffer) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
  glTextureBuffer(name, internal_format, buffer.name());
  return Texture(name);
}

std::size_t most_texels() {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  return static_cast<std::size_t>(std::max(most, 0));
}

Result<Framebuffer> make_layered_framebuffer(std::span<const GLuint> colors, GLuint depth, std::string_view what,
                                             GLint level) {
  Framebuffer framebuffer = make_framebuffer();
  std::vector<GLenum> draw_buffers;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const GLenum attachment = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i);
    draw_buffers.push_back(colors[i] != 0 ? attachment : GL_NONE);
    if (colors[i] != 0) glNamedFramebufferTexture(framebuffer.name(), attachment, colors[i], level);
  }
  if (depth != 0) glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth, level);
  if (draw_buffers.empty()) draw_buffers.push_back(GL_NONE);
  glNamedFramebufferDrawBuffers(framebuffer.name(), static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
  const GLenum status = glCheckNamedFramebufferStatus(framebuffer.name(), GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    return Error(fmt::format("the GPU cannot draw into {} (framebuffer status {:#x})", what, status));
  return framebuffer;
}

}  // namespace lfd::gl
