// Compiling and linking.
#include "rendernode/gl/program.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "base/log.h"
#include "shaders/embedded.h"

namespace lfd::gl {
namespace {

Result<std::string_view> embedded(std::string_view name) {
  const auto& table = embedded_shaders();
  const auto found = std::ranges::find(table, name, &EmbeddedShader::name);
  if (found == table.end()) return Error(fmt::format("no shader {}", name));
  return found->source;
}

Status append_resolved(std::string_view source, std::set<std::string>& seen, std::string& out) {
  std::istringstream lines{std::string(source)};
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kInclude = "#include \"";
    if (!line.starts_with(kInclude)) {
      out += line + '\n';
      continue;
    }
    const std::string name = line.substr(kInclude.size(), line.rfind('"') - kInclude.size());
    if (!seen.insert(name).second) continue;
    LFD_TRY(const std::string_view included, embedded(name));
    LFD_TRY_STATUS(append_resolved(included, seen, out));
  }
  return {};
}

Result<std::string> resolved(std::string_view source, const Flags& flags) {
  std::string text;
  std::set<std::string> seen;
  LFD_TRY_STATUS(append_resolved(source, seen, text));
  std::string defines;
  for (const auto& flag : flags) defines += "#define " + flag + "\n";
  // #version must stay first; the header comment before it is allowed.
  const auto version = text.find("#version");
  const auto after = text.find('\n', version) + 1;
  text.insert(after, defines);
  return text;
}

GLenum stage_of(std::string_view name) {
  if (name.ends_with(".vert")) return GL_VERTEX_SHADER;
  if (name.ends_with(".tesc")) return GL_TESS_CONTROL_SHADER;
  if (name.ends_with(".tese")) return GL_TESS_EVALUATION_SHADER;
  return name.ends_with(".frag") ? GL_FRAGMENT_SHADER : GL_COMPUTE_SHADER;
}

Result<Shader> compile(GLenum stage, std::string_view name, const std::string& text) {
  Shader shader(glCreateShader(stage));
  const char* source = text.c_str();
  glShaderSource(shader.name(), 1, &source, nullptr);
  glCompileShader(shader.name());
  GLint good = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::string report(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader.name(), static_cast<GLsizei>(report.size()), &length, report.data());
  report.resize(static_cast<std::size_t>(length));
  return Error(fmt::format("shader {}: {}", name, report));
}

Result<Program> link(const std::vector<Shader>& shaders, std::string_view name) {
  Program program(glCreateProgram());
  for (const auto& shader : shaders) glAttachShader(program.name(), shader.name());
  glLinkProgram(program.name());
  for (const auto& shader : shaders) glDetachShader(program.name(), shader.name());
  GLint good = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return program;
  std::string report(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(program.name(), static_cast<GLsizei>(report.size()), &length, report.data());
  report.resize(static_cast<std::size_t>(length));
  return Error(fmt::format("program {}: {}", name, report));
}

}  // namespace

Result<std::string> shader_text(std::string_view name, const Flags& flags) {
  LFD_TRY(const std::string_view source, embedded(name));
  return resolved(source, flags);
}

Result<Program> make_program(const std::vector<std::string>& stages, const Flags& flags) {
  std::vector<Shader> shaders;
  std::string name;
  for (const std::string& stage : stages) {
    LFD_TRY(const std::string text, shader_text(stage, flags));
    LFD_TRY(Shader shader, compile(stage_of(stage), stage, text));
    shaders.push_back(std::move(shader));
    name = stage;
  }
  return link(shaders, name);
}

Result<Program> make_compute_program(std::string_view source) {
  LFD_TRY(const std::string text, resolved(source, {}));
  std::vector<Shader> shaders;
  LFD_TRY(Shader shader, compile(GL_COMPUTE_SHADER, "compute", text));
  shaders.push_back(std::move(shader));
  return link(shaders, "compute");
}

}  // namespace lfd::gl
