// Making GL objects by direct state access; sizes in pixels and bytes.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "calibration/spaces/pixel.h"
#include "rendernode/gl/handle.h"

namespace lfd::gl {

Framebuffer make_framebuffer();
VertexArray make_vertex_array();
Query make_query(GLenum target);

// A two-dimensional array texture without content.
Texture make_array_texture(GLenum internal_format, ImageSize size, int layers, int levels = 1);

// A buffer as texels, which is to outlive it. At most most_texels() of them can be read.
Texture make_buffer_texture(GLenum internal_format, const Buffer& buffer);
std::size_t most_texels();

// A framebuffer over all layers of a mip level of these array textures: color attachment i is colors[i]; depth may be
// 0. Error: GL cannot draw into them ("the GPU cannot draw into WHAT"), as where it has promised more memory than there
// is.
Result<Framebuffer> make_layered_framebuffer(std::span<const GLuint> colors, GLuint depth, std::string_view what,
                                             GLint level = 0);

// A buffer with this content; never of size 0 (GL refuses that).
template <class T>
Buffer make_buffer(std::span<const T> content, GLbitfield flags = 0) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  const T nothing{};
  const bool empty = content.empty();
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(empty ? sizeof(T) : content.size_bytes()),
                       empty ? &nothing : content.data(), flags);
  return Buffer(name);
}

template <class T>
Buffer make_buffer(const std::vector<T>& content, GLbitfield flags = 0) {
  return make_buffer(std::span<const T>(content), flags);
}

}  // namespace lfd::gl
