// Structs of shaders/shared are laid out by C++ as the driver lays them out in the blocks they are bound to.
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <regex>
#include <set>

#include "rendernode/gl/program.h"
#include "shaders/embedded.h"
#include "shaders/shared/glsl_types.h"
#include "tests/support/rendering.h"

namespace lfd {
namespace {

using Offsets = std::map<std::string, std::size_t>;

struct Struct {
  const char* file;
  const char* name;
  std::size_t size;
  Offsets offset;
};

#define LFD_AT(type, field) \
  { #field, offsetof(shared::type, field) }

std::vector<Struct> all_structs() {
  return {
      {"ao_params",
       "AoParams",
       sizeof(shared::AoParams),
       {LFD_AT(AoParams, radii), LFD_AT(AoParams, noise), LFD_AT(AoParams, options)}},
      {"color_params",
       "ColorParams",
       sizeof(shared::ColorParams),
       {LFD_AT(ColorParams, device_from_display_0), LFD_AT(ColorParams, device_from_display_1),
        LFD_AT(ColorParams, device_from_display_2), LFD_AT(ColorParams, black_level), LFD_AT(ColorParams, gain),
        LFD_AT(ColorParams, curve_0), LFD_AT(ColorParams, curve_1), LFD_AT(ColorParams, curve_2)}},
      {"draw_record",
       "DrawRecord",
       sizeof(shared::DrawRecord),
       {LFD_AT(DrawRecord, layer), LFD_AT(DrawRecord, primitive_base), LFD_AT(DrawRecord, material),
        LFD_AT(DrawRecord, flags)}},
      {"frame_params",
       "FrameParams",
       sizeof(shared::FrameParams),
       {LFD_AT(FrameParams, physical_from_world_0), LFD_AT(FrameParams, physical_from_world_1),
        LFD_AT(FrameParams, physical_from_world_2), LFD_AT(FrameParams, world_from_physical_0),
        LFD_AT(FrameParams, world_from_physical_1), LFD_AT(FrameParams, world_from_physical_2),
        LFD_AT(FrameParams, depth), LFD_AT(FrameParams, background), LFD_AT(FrameParams, ambient_occlusion)}},
      {"light_params",
       "LightParams",
       sizeof(shared::LightParams),
       {LFD_AT(LightParams, color_kind), LFD_AT(LightParams, position_range), LFD_AT(LightParams, direction),
        LFD_AT(LightParams, cone)}},
      {"material_params",
       "MaterialParams",
       sizeof(shared::MaterialParams),
       {LFD_AT(MaterialParams, base_color), LFD_AT(MaterialParams, uv_transform_0),
        LFD_AT(MaterialParams, uv_transform_1), LFD_AT(MaterialParams, alpha)}},
      {"module_params",
       "ModuleParams",
       sizeof(shared::ModuleParams),
       {LFD_AT(ModuleParams, emitter), LFD_AT(ModuleParams, observer), LFD_AT(ModuleParams, screen),
        LFD_AT(ModuleParams, surface), LFD_AT(ModuleParams, image_from_screen_0),
        LFD_AT(ModuleParams, image_from_screen_1), LFD_AT(ModuleParams, image_from_screen_2),
        LFD_AT(ModuleParams, screen_from_image_0), LFD_AT(ModuleParams, screen_from_image_1),
        LFD_AT(ModuleParams, screen_from_image_2), LFD_AT(ModuleParams, pinhole_0), LFD_AT(ModuleParams, pinhole_1),
        LFD_AT(ModuleParams, pinhole_2), LFD_AT(ModuleParams, focal_principal), LFD_AT(ModuleParams, distortion),
        LFD_AT(ModuleParams, tangential)}},
      {"pattern_params",
       "PatternParams",
       sizeof(shared::PatternParams),
       {LFD_AT(PatternParams, what), LFD_AT(PatternParams, color)}},
      {"primitive_plane",
       "PrimitivePlane",
       sizeof(shared::PrimitivePlane),
       {LFD_AT(PrimitivePlane, normal_offset), LFD_AT(PrimitivePlane, range), LFD_AT(PrimitivePlane, inside_0),
        LFD_AT(PrimitivePlane, inside_1)}},
      {"sharing_params",
       "SharingParams",
       sizeof(shared::SharingParams),
       {LFD_AT(SharingParams, window), LFD_AT(SharingParams, turn), LFD_AT(SharingParams, rank)}},
  };
}

struct Layout {
  Offsets offset;
  std::size_t stride = 0;  // of an array of them
};

std::string source_of(const Struct& one, const std::string& block, const std::string& main) {
  return std::string("#version 450 core\nlayout(local_size_x = 1) in;\n#include \"shared/") + one.file + ".glsl\"\n" +
         block + "\nvoid main() { " + main + " }\n";
}

// What the driver makes of `readonly buffer { S all[]; }`.
Layout storage_layout_of(const Struct& one) {
  const std::string text =
      source_of(one, std::string("layout(std430, binding = 0) buffer All { ") + one.name + " all[]; };",
                "all[gl_GlobalInvocationID.x] = all[gl_GlobalInvocationID.x + 1u];");
  auto program = gl::make_compute_program(text);
  EXPECT_TRUE(program) << program.error().message();
  if (!program) return {};
  Layout layout;
  GLint count = 0;
  glGetProgramInterfaceiv(program->name(), GL_BUFFER_VARIABLE, GL_ACTIVE_RESOURCES, &count);
  for (GLint i = 0; i < count; ++i) {
    const GLenum wanted[] = {GL_OFFSET, GL_TOP_LEVEL_ARRAY_STRIDE};
    GLint values[2] = {};
    glGetProgramResourceiv(program->name(), GL_BUFFER_VARIABLE, static_cast<GLuint>(i), 2, wanted, 2, nullptr, values);
    char name[256] = {};
    glGetProgramResourceName(program->name(), GL_BUFFER_VARIABLE, static_cast<GLuint>(i), sizeof(name), nullptr, name);
    const std::string full = name;  // "all[0].radii", by some drivers "All.all[0].radii"
    layout.offset[full.substr(full.rfind('.') + 1)] = static_cast<std::size_t>(values[0]);
    layout.stride = static_cast<std::size_t>(values[1]);
  }
  return layout;
}

// What the driver makes of `uniform { S all[2]; }`; the stride is what lies between the two.
Layout uniform_layout_of(const Struct& one) {
  std::string sum = "vec4 sum = vec4(0.0);";
  for (const auto& [field, offset] : one.offset) {
    for (const char* k : {"0", "1"}) sum += std::string(" sum += vec4(all[") + k + "]." + field + ");";
  }
  const std::string text = source_of(one,
                                     std::string("layout(std140, binding = 0) uniform All { ") + one.name +
                                         " all[2]; };\nlayout(std430, binding = 1) buffer Out { vec4 out_sum; };",
                                     sum + " out_sum = sum;");
  auto program = gl::make_compute_program(text);
  EXPECT_TRUE(program) << program.error().message();
  if (!program) return {};
  Layout layout;
  for (const auto& [field, offset] : one.offset) {
    GLint offsets[2] = {-1, -1};
    for (int k = 0; k < 2; ++k) {
      const std::string name = "all[" + std::to_string(k) + "]." + field;
      const char* const text_of_name = name.c_str();
      GLuint index = GL_INVALID_INDEX;
      glGetUniformIndices(program->name(), 1, &text_of_name, &index);
      EXPECT_NE(index, GL_INVALID_INDEX) << name;
      if (index != GL_INVALID_INDEX) glGetActiveUniformsiv(program->name(), 1, &index, GL_UNIFORM_OFFSET, &offsets[k]);
    }
    layout.offset[field] = static_cast<std::size_t>(offsets[0]);
    layout.stride = static_cast<std::size_t>(offsets[1] - offsets[0]);
  }
  return layout;
}

// Those that shaders read from uniform blocks.
bool is_uniform(const Struct& one) {
  return std::set<std::string>{"AoParams",     "ColorParams",   "FrameParams",
                               "ModuleParams", "PatternParams", "SharingParams"}
      .contains(one.name);
}

TEST(SharedStructs, AreLaidOutAlikeInBothLanguages) {
  testing_support::context();
  for (const Struct& one : all_structs()) {
    const Layout layout = is_uniform(one) ? uniform_layout_of(one) : storage_layout_of(one);
    EXPECT_EQ(layout.offset, one.offset) << one.name;
    EXPECT_EQ(layout.stride, one.size) << one.name;
  }
}

TEST(SharedStructs, EveryFileOfTheFolderIsCompared) {
  std::set<std::string> compared{"shared/bindings.glsl"};
  for (const Struct& one : all_structs()) compared.insert(std::string("shared/") + one.file + ".glsl");
  for (const EmbeddedShader& shader : embedded_shaders()) {
    if (!shader.name.starts_with("shared/")) continue;
    EXPECT_TRUE(compared.contains(std::string(shader.name))) << shader.name;
  }
}

TEST(SharedStructs, HaveNoVec3) {
  for (const EmbeddedShader& shader : embedded_shaders()) {
    if (!shader.name.starts_with("shared/")) continue;
    EXPECT_EQ(shader.source.find("vec3"), std::string_view::npos) << shader.name;
  }
}

// Buffers among themselves, texture units among themselves.
TEST(SharedStructs, BindingsAreGivenOutOnce) {
  const std::regex line(R"(#define (BINDING|UNIT)_\w+ (\d+))");
  std::set<std::string> given;
  std::size_t count = 0;
  for (const EmbeddedShader& shader : embedded_shaders()) {
    const std::string source(shader.source);
    for (std::sregex_iterator found(source.begin(), source.end(), line), end; found != end; ++found, ++count) {
      EXPECT_EQ(shader.name, "shared/bindings.glsl") << found->str();
      EXPECT_TRUE(given.insert((*found)[1].str() + " " + (*found)[2].str()).second) << found->str();
    }
  }
  EXPECT_EQ(count, 21U);
}

}  // namespace
}  // namespace lfd
