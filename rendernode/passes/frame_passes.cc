// The six passes; those of ambient occlusion: occlusion_passes.cc; that of test patterns: pattern_pass.cc.
#include "rendernode/passes/frame_passes.h"

#include <array>
#include <cstddef>

#include "rendernode/passes/gpu_sharing.h"
#include "rendernode/passes/scissor.h"

namespace lfd {
namespace {

constexpr GLint kFirstLayer = 0;  // uniform location of layers.vert

gl::VertexArray make_surface_array() {
  gl::VertexArray array = gl::make_vertex_array();
  const auto attribute = [&](GLuint index, GLint size, GLenum type, GLboolean normalised, std::size_t offset) {
    glEnableVertexArrayAttrib(array.name(), index);
    glVertexArrayAttribFormat(array.name(), index, size, type, normalised, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array.name(), index, 0);
  };
  attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(SurfaceVertex, position));
  attribute(1, 3, GL_SHORT, GL_TRUE, offsetof(SurfaceVertex, normal));
  attribute(2, 2, GL_FLOAT, GL_FALSE, offsetof(SurfaceVertex, uv));
  attribute(3, 4, GL_HALF_FLOAT, GL_FALSE, offsetof(SurfaceVertex, color));
  glEnableVertexArrayAttrib(array.name(), 4);
  glVertexArrayAttribIFormat(array.name(), 4, 4, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array.name(), 4, 1);
  glVertexArrayBindingDivisor(array.name(), 1, 1);
  return array;
}

glm::vec4 row_of(const glm::dmat3& m, int row, double w) { return {m[0][row], m[1][row], m[2][row], w}; }

void bind_texture(GLuint unit, GLuint texture) { glBindTextureUnit(unit, texture); }

}  // namespace

shared::FrameParams frame_params(const FrameInputs& in, int lights) {
  shared::FrameParams params{};
  const glm::dmat3 to_physical = physical_from_world(in.roi).linear, to_world = world_from_physical(in.roi).linear;
  const glm::dvec3 centre = to_glm(in.roi.physical_centre), back = -(to_world * centre);
  params.physical_from_world_0 = row_of(to_physical, 0, centre.x);
  params.physical_from_world_1 = row_of(to_physical, 1, centre.y);
  params.physical_from_world_2 = row_of(to_physical, 2, centre.z);
  params.world_from_physical_0 = row_of(to_world, 0, back.x);
  params.world_from_physical_1 = row_of(to_world, 1, back.y);
  params.world_from_physical_2 = row_of(to_world, 2, back.z);
  params.depth = {in.limits.front, in.limits.depth_scale, in.limits.back, in.settings.tessellation_px};
  params.background = glm::vec4(in.settings.background, lights);
  const AoSettings& ao = in.settings.ao;
  const float mode = !ao.enabled ? 0.0F : ao.target == AoTarget::kWholeColor ? 2.0F : 1.0F;
  params.ambient_occlusion = {ao.curve.a, ao.curve.b, ao.curve.c, mode};
  return params;
}

FramePasses::FramePasses() : surface_array_(make_surface_array()), empty_array_(gl::make_vertex_array()) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // row 0 of a texture is row 0 of the image: the top
  glEnable(GL_DEPTH_CLAMP);                      // the limits in z are cut beforehand
  glEnable(GL_CLIP_DISTANCE0);
  glEnable(GL_FRAMEBUFFER_SRGB);
}

Result<GLuint> FramePasses::program(const std::vector<std::string>& stages, const gl::Flags& flags) {
  std::string key;
  for (const auto& stage : stages) key += stage + " ";
  for (const auto& flag : flags) key += " " + flag;
  if (const auto known = programs_.find(key); known != programs_.end()) return known->second.name();
  LFD_TRY(gl::Program made, gl::make_program(stages, flags));
  return programs_.emplace(key, std::move(made)).first->second.name();
}

void FramePasses::bind_inputs(const FramePlan& plan, const CommandList& commands, const FrameInputs& in) {
  const shared::FrameParams params = frame_params(in, in.lights.count);
  frame_params_ = gl::make_buffer(std::span(&params, 1));
  const AoSettings& ao = in.settings.ao;
  const shared::AoParams ao_params{{ao.radius_in_world_m(in.roi.diagonal_m()), ao.radii, ao.samples, ao.seed % 65536},
                                   noise_origin(in.roi, in.display),
                                   {ao.least_samples, in.modules.guard_band_px, 0, 0}};
  ao_params_ = gl::make_buffer(std::span(&ao_params, 1));
  std::vector<glm::vec4> samples =
      plan.sharing.has_neighbours() ? dealt_samples(ao, plan.sharing.parts) : ao.sample_set();
  samples.resize(AO_MOST_SAMPLES);
  ao_samples_ = gl::make_buffer(samples);
  std::vector<float> parameters(ao.parameters.begin(), ao.parameters.end());
  parameters.resize((parameters.size() / 4 + 1) * 4);  // a uniform block is whole vectors
  ao_parameters_ = gl::make_buffer(parameters);
  const auto bind = [](GLenum target, GLuint binding, const gl::Buffer& buffer) {
    glBindBufferBase(target, binding, buffer.name());
  };
  bind(GL_UNIFORM_BUFFER, BINDING_MODULES, in.modules.params);
  bind(GL_UNIFORM_BUFFER, BINDING_FRAME, frame_params_);
  bind(GL_UNIFORM_BUFFER, BINDING_AO, ao_params_);
  bind(GL_UNIFORM_BUFFER, BINDING_AO_METHOD, ao_parameters_);
  bind(GL_UNIFORM_BUFFER, BINDING_AO_SAMPLES, ao_samples_);
  bind(GL_SHADER_STORAGE_BUFFER, BINDING_MATERIALS, in.materials.params);
  bind(GL_SHADER_STORAGE_BUFFER, BINDING_LIGHTS, in.lights.params);
  bind(GL_SHADER_STORAGE_BUFFER, BINDING_LAYERS, commands.layers);
  glVertexArrayVertexBuffer(surface_array_.name(), 0, in.geometry.vertices.name(), 0, sizeof(SurfaceVertex));
  glVertexArrayVertexBuffer(surface_array_.name(), 1, commands.records.name(), 0, sizeof(shared::DrawRecord));
  glVertexArrayElementBuffer(surface_array_.name(), in.geometry.indices.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.commands.name());
  bind_texture(UNIT_PLANES, in.geometry.plane_texels.name());
  if (in.modules.has_tables()) bind_texture(UNIT_PIXEL_TABLE, in.modules.pixel_tables.name());
  if (in.modules.warp_tables) bind_texture(UNIT_WARP_TABLE, in.modules.warp_tables.name());
  if (!in.modules.colors) return;
  bind(GL_UNIFORM_BUFFER, BINDING_COLORS, in.modules.colors->params);
  bind(GL_SHADER_STORAGE_BUFFER, BINDING_COLOR_SAMPLES, in.modules.colors->samples);
}

Status FramePasses::submit(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs,
                           Targets& targets, PassTimers& timers) {
  LFD_TRY_STATUS(targets.prepare(plan));
  if (commands.batches.empty()) return {};
  bind_inputs(plan, commands, inputs);
  glViewport(0, 0, targets.size().width, targets.size().height);
  if (plan.pattern) return patterns(plan, commands, inputs, targets, timers);
  if (plan.z_prepass) LFD_TRY_STATUS(z_prepass(plan, commands, inputs, targets, timers));
  LFD_TRY_STATUS(gbuffer(plan, commands, inputs, targets, timers));
  glDisable(GL_DEPTH_TEST);
  if (plan.pyramid_levels > 0) LFD_TRY_STATUS(pyramid(plan, commands, targets, timers));
  if (plan.ao) LFD_TRY_STATUS(ambient_occlusion(plan, commands, inputs, targets, timers));
  if (plan.share) LFD_TRY_STATUS(share(plan, commands, inputs, targets, timers));
  if (plan.blur) LFD_TRY_STATUS(blur(plan, commands, inputs.settings.ao, targets, timers));
  if (plan.post) LFD_TRY_STATUS(post(plan, commands, inputs, targets, timers));
  return {};
}

Status FramePasses::draw_surfaces(const char* fragment, gl::Flags flags, const Batch& batch, const FrameInputs& in) {
  glBindVertexArray(surface_array_.name());
  flags.insert(flags.end(), in.modules.map_flags.begin(), in.modules.map_flags.end());
  if (in.modules.has_tables()) flags.emplace_back("PIXEL_TABLE");
  if (in.modules.warp_tables) flags.emplace_back("WARP_TABLE");
  if (in.modules.guard_band_px > 0) flags.emplace_back("GUARD_BAND");
  if (in.settings.interpolated_position) flags.emplace_back("INTERPOLATED");
  const bool tessellates = in.settings.tessellation_px > 0;
  std::vector<std::string> stages{"passes/surface.vert", fragment};
  if (tessellates) {
    stages = {"passes/surface_patch.vert", "passes/surface_patch.tesc", "passes/surface_patch.tese", fragment};
    glPatchParameteri(GL_PATCH_VERTICES, 3);
  }
  for (const auto& submission : batch.submissions) {
    gl::Flags variant = flags;
    if (submission.alpha_mask) variant.emplace_back("ALPHA_MASK");
    const bool needs_color = std::string_view(fragment) == "passes/surface_gbuffer.frag" || submission.alpha_mask;
    if (needs_color) variant.emplace_back("ATTRIBUTES");
    if (submission.texture_group >= 0 && needs_color) {
      variant.emplace_back("TEXTURED");
      const TextureGroup& group = in.materials.groups[static_cast<std::size_t>(submission.texture_group)];
      bind_texture(UNIT_TEXTURE, group.texture.name());
      glBindSampler(UNIT_TEXTURE, group.sampler.name());
    }
    LFD_TRY(const GLuint name, program(stages, variant));
    glUseProgram(name);
    constexpr std::size_t kCommandBytes = 20;
    glMultiDrawElementsIndirect(tessellates ? GL_PATCHES : GL_TRIANGLES, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(kCommandBytes * submission.first_command),
                                static_cast<GLsizei>(submission.count), 0);
  }
  return {};
}

Status FramePasses::z_prepass(const FramePlan&, const CommandList& commands, const FrameInputs& inputs,
                              Targets& targets, PassTimers& timers) {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, targets.depth_only());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  constexpr float kFar = 1;
  glClearNamedFramebufferfv(targets.depth_only(), GL_DEPTH, 0, &kFar);
  for (const auto& batch : commands.batches) {
    timers.begin("z_prepass", batch.layers);
    const Status status = draw_surfaces("passes/surface_depth.frag", {}, batch, inputs);
    timers.end();
    LFD_TRY_STATUS(status);
  }
  return {};
}

Status FramePasses::gbuffer(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs,
                            Targets& targets, PassTimers& timers) {
  const GLuint framebuffer = targets.geometry(plan);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  constexpr float kFar = 1;
  constexpr std::array<float, 4> kNothing{};
  const std::array<float, 4> background{inputs.settings.background.r, inputs.settings.background.g,
                                        inputs.settings.background.b, 0};
  glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, background.data());
  if (plan.position) glClearNamedFramebufferfv(framebuffer, GL_COLOR, 1, kNothing.data());
  if (plan.normal) glClearNamedFramebufferfv(framebuffer, GL_COLOR, 2, kNothing.data());
  if (!plan.z_prepass) glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &kFar);
  glDepthMask(plan.z_prepass ? GL_FALSE : GL_TRUE);
  glDepthFunc(plan.z_prepass ? GL_EQUAL : GL_LEQUAL);
  gl::Flags flags;
  if (plan.position) flags.emplace_back("WRITE_POSITION");
  if (plan.normal) flags.emplace_back("WRITE_NORMAL");
  for (const auto& batch : commands.batches) {
    timers.begin("gbuffer", batch.layers);
    const Status status = draw_surfaces("passes/surface_gbuffer.frag", flags, batch, inputs);
    timers.end();
    LFD_TRY_STATUS(status);
  }
  glBindSampler(UNIT_TEXTURE, 0);
  return {};
}

void FramePasses::draw_layers(const CommandList& commands, const char* pass, PassTimers& timers) {
  for (const auto& batch : commands.batches) {
    timers.begin(pass, batch.layers);
    draw_layers_of(batch);
    timers.end();
  }
}

void FramePasses::draw_layers_of(const Batch& batch) {
  glBindVertexArray(empty_array_.name());
  glUniform1i(kFirstLayer, static_cast<GLint>(batch.first_layer));
  glDrawArraysInstanced(GL_TRIANGLES, 0, 3, static_cast<GLsizei>(batch.layer_count));
}

Status FramePasses::post(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs,
                         const Targets& targets, PassTimers& timers) {
  gl::Flags flags;
  if (plan.ao) flags.emplace_back("READ_AO");
  if (plan.position && inputs.lights.facts.need_position) flags.emplace_back("READ_POSITION");
  if (plan.normal && inputs.lights.facts.need_normal) flags.emplace_back("READ_NORMAL");
  if (plan.bent) flags.emplace_back("BENT");
  if (plan.color) flags.emplace_back("COLOR");
  LFD_TRY(const GLuint name, program({"passes/layers.vert", "passes/post.frag"}, flags));
  glUseProgram(name);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, targets.color_framebuffer());
  bind_texture(UNIT_ALBEDO, targets.albedo());
  if (plan.position) bind_texture(UNIT_POSITION, targets.position());
  if (plan.normal) bind_texture(UNIT_NORMAL, targets.normal());
  if (plan.ao) bind_texture(UNIT_AO, targets.ao(0));
  const Scissor own_image(plan.guard_band_px, targets.size());
  draw_layers(commands, "post", timers);
  return {};
}

}  // namespace lfd
