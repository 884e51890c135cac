// Shader functions called from tests: a small compute shader over arrays of vec4.
#pragma once

#include <gtest/gtest.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <random>
#include <string>
#include <vector>

#include "rendernode/gl/objects.h"
#include "rendernode/gl/program.h"
#include "tests/support/rendering.h"

namespace lfd::testing_support {

// Runs `body` once for each input. In it `i` is the number of the input, `a` its value, and `b[0]` and on are to be
// written, `outputs` of them for each. `head`: includes and declarations. `structs`: bound as buffer 2 for the head to
// declare, where given.
inline std::vector<glm::vec4> compute(const std::string& head, const std::string& body,
                                      const std::vector<glm::vec4>& inputs, int outputs,
                                      const gl::Buffer* structs = nullptr) {
  context();
  const std::string count = std::to_string(inputs.size()), out = std::to_string(outputs);
  const std::string text = "#version 450 core\nlayout(local_size_x = 64) in;\n" + head +
                           "\nlayout(std430, binding = 0) readonly buffer In { vec4 inputs[]; };\n"
                           "layout(std430, binding = 1) writeonly buffer Out { vec4 outputs[]; };\n"
                           "void main() {\n  uint i = gl_GlobalInvocationID.x;\n  if (i >= " +
                           count +
                           "u) return;\n"
                           "  vec4 a = inputs[i];\n  vec4 b[" +
                           out + "];\n" + body + "\n  for (int k = 0; k < " + out + "; ++k) outputs[i * " + out +
                           "u + uint(k)] = b[k];\n}\n";
  auto program = gl::make_compute_program(text);
  EXPECT_TRUE(program) << program.error().message();
  if (!program) return {};
  std::vector<glm::vec4> results(inputs.size() * static_cast<std::size_t>(outputs));
  const gl::Buffer in = gl::make_buffer(inputs), result = gl::make_buffer(results);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, result.name());
  if (structs != nullptr) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, structs->name());
  glUseProgram(program->name());
  glDispatchCompute(static_cast<GLuint>((inputs.size() + 63) / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(result.name(), 0, static_cast<GLsizeiptr>(results.size() * sizeof(glm::vec4)),
                          results.data());
  glUseProgram(0);
  return results;
}

// Uniform between two corners; seeded. The fourth number is 0.
inline std::vector<glm::vec4> random_points(int count, glm::vec3 low, glm::vec3 high, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<glm::vec4> points;
  for (int i = 0; i < count; ++i) {
    const float x = unit(random), y = unit(random), z = unit(random);
    points.emplace_back(low + (high - low) * glm::vec3(x, y, z), 0);
  }
  return points;
}

}  // namespace lfd::testing_support
