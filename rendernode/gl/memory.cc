// GL's error flags.
#include "rendernode/gl/memory.h"

#include <epoxy/gl.h>

#include "base/log.h"
namespace lfd::gl {

Status memory_status(std::string_view what) {
  bool out_of_memory = false;
  for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
    out_of_memory = out_of_memory || error == GL_OUT_OF_MEMORY;
    if (error == GL_CONTEXT_LOST) break;  // for ever
  }
  if (out_of_memory) return Error(fmt::format("the GPU has no memory for {}", what));
  return {};
}

}  // namespace lfd::gl
