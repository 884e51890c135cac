// One dispatch over displays and points.
#include "bench/stability/gpu_points.h"

#include "rendernode/gl/objects.h"
#include "rendernode/gl/program.h"
#include "rendernode/passes/gpu_modules.h"

namespace lfd::bench {

Result<std::vector<glm::vec4>> gpu_images(const std::vector<DisplayCalibration>& displays,
                                          const std::vector<Point3<Physical>>& points) {
  LFD_TRY(const gl::Program program, gl::make_program({"bench/map_points.comp"}));
  std::vector<shared::ModuleParams> modules;
  for (const DisplayCalibration& display : displays)
    modules.push_back(module_params(display, display.modules[0], nullptr, {}));
  std::vector<glm::vec4> inputs;
  for (const Point3<Physical>& p : points) inputs.emplace_back(p.x, p.y, p.z, 0);
  std::vector<glm::vec4> images(displays.size() * points.size());
  const gl::Buffer in = gl::make_buffer(inputs), out = gl::make_buffer(images), params = gl::make_buffer(modules);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, params.name());
  glUseProgram(program.name());
  glDispatchCompute(static_cast<GLuint>((inputs.size() + 63) / 64), static_cast<GLuint>(displays.size()), 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(out.name(), 0, static_cast<GLsizeiptr>(images.size() * sizeof(glm::vec4)), images.data());
  glUseProgram(0);
  return images;
}

}  // namespace lfd::bench
