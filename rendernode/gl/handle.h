// One class deletes GL names; a moved-from handle holds nothing (name 0).
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace lfd::gl {

// Owns one GL name. Made and destroyed on the thread of its context.
template <class Traits>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle() {
    if (name_ != 0) Traits::destroy(name_);
  }

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

struct BufferTraits {
  static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct TextureTraits {
  static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct FramebufferTraits {
  static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct VertexArrayTraits {
  static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct QueryTraits {
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};
struct SamplerTraits {
  static void destroy(GLuint name) { glDeleteSamplers(1, &name); }
};
struct ProgramTraits {
  static void destroy(GLuint name) { glDeleteProgram(name); }
};
struct ShaderTraits {
  static void destroy(GLuint name) { glDeleteShader(name); }
};

using Buffer = Handle<BufferTraits>;
using Texture = Handle<TextureTraits>;
using Framebuffer = Handle<FramebufferTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using Query = Handle<QueryTraits>;
using Sampler = Handle<SamplerTraits>;
using Program = Handle<ProgramTraits>;
using Shader = Handle<ShaderTraits>;

}  // namespace lfd::gl
