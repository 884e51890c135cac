// The passes of ambient occlusion: pyramid, the method itself, from half the resolution to the full one, what
// neighbours found, blur.
#include <algorithm>
#include <array>
#include <utility>

#include "base/log.h"
#include "rendernode/passes/blur_weights.h"
#include "rendernode/passes/frame_passes.h"
#include "rendernode/passes/gpu_sharing.h"
#include "rendernode/passes/scissor.h"

namespace lfd {
namespace {

gl::Flags flags_of(const FramePlan& plan, gl::Flags flags = {}) {
  if (plan.bent) flags.emplace_back("BENT");
  return flags;
}

constexpr GLint kBlurDirection = 1, kBlurTaps = 2, kBlurWeights = 3;  // uniform locations of both blurs
constexpr GLint kFinerMip = 1, kFinerSize = 2;                        // of the pyramid's passes

// How far a blur looks to each side, pixels.
int reach_of_blur(const AoSettings& ao) {
  if (!ao.blur_enabled) return 0;
  return ao.blur == AoBlur::kGaussian ? gaussian_taps(ao.blur_sigma_px) : ao.blur_taps;
}

}  // namespace

Status FramePasses::pyramid(const FramePlan& plan, const CommandList& commands, const Targets& targets,
                            PassTimers& timers) {
  const char* fragment = plan.pyramid_factor == 3 ? "passes/pyramid_average.frag" : "passes/pyramid_pick.frag";
  LFD_TRY(const GLuint name, program({"passes/layers.vert", fragment}, {}));
  glUseProgram(name);
  glBindTextureUnit(UNIT_POSITION, targets.position());
  ImageSize finer = targets.size();
  for (int i = 0; i < plan.pyramid_levels; ++i) {
    const PositionPyramid::Level& level = targets.pyramid().levels()[static_cast<std::size_t>(i)];
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, level.framebuffer.name());
    glViewport(0, 0, level.size.width, level.size.height);
    glUniform1i(kFinerMip, std::max(0, i - 1));
    glUniform2i(kFinerSize, finer.width, finer.height);
    draw_layers(commands, "pyramid", timers);
    glTextureBarrier();  // the next level reads another mip level of the texture that it writes
    glBindTextureUnit(UNIT_POSITION, targets.pyramid().position());
    finer = level.size;
  }
  glViewport(0, 0, targets.size().width, targets.size().height);
  return {};
}

void FramePasses::draw_occlusion(const CommandList& commands, const char* pass, PassTimers& timers,
                                 GLuint framebuffer) {
  constexpr std::array<float, 4> kNoSurface{-1, 0, 0, 0};  // of lib/ao_value.glsl
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER);
  for (const Batch& batch : commands.batches) {
    timers.begin(pass, batch.layers);
    if (&batch == &commands.batches.front()) glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, kNoSurface.data());
    draw_layers_of(batch);
    timers.end();
  }
  glDisable(GL_DEPTH_TEST);
}

Status FramePasses::ambient_occlusion(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs,
                                      const Targets& targets, PassTimers& timers) {
  const occlusion::Method& method = *inputs.settings.ao.method;
  const bool reads_normal = method.normal || plan.bent;
  gl::Flags flags = flags_of(plan, inputs.modules.map_flags);
  const bool is_shared = plan.sharing.has_neighbours();
  if (is_shared || plan.share) {
    sharing_ = gl::make_buffer(sharing_params(plan.sharing, inputs.settings.ao));
    glBindBufferBase(GL_UNIFORM_BUFFER, BINDING_SHARING, sharing_.name());
  }
  for (const auto& [is_set, flag] : {std::pair{static_cast<bool>(inputs.modules.warp_tables), "WARP_TABLE"},
                                     {reads_normal, "NORMAL"},
                                     {plan.upsample, "HALF_RESOLUTION"},
                                     {plan.guard_band_px > 0, "GUARD_BAND"},
                                     {is_shared, "SHARED"},
                                     {is_shared && inputs.settings.ao.shared_open_air, "OPEN_AIR"},
                                     {method.pyramid != occlusion::Pyramid::kNone, "PYRAMID"}}) {
    if (is_set) flags.emplace_back(flag);
  }
  LFD_TRY(const GLuint name, program({"passes/layers.vert", fmt::format("ao/{}.frag", method.name)}, flags));
  glUseProgram(name);
  const ImageSize size = plan.upsample ? targets.half_size() : targets.size();
  glViewport(0, 0, size.width, size.height);
  glBindTextureUnit(UNIT_POSITION, targets.position());
  if (reads_normal) glBindTextureUnit(UNIT_NORMAL, targets.normal());
  if (plan.pyramid_levels > 0) glBindTextureUnit(UNIT_PYRAMID, targets.pyramid().position());
  {
    const int reach = reach_of_blur(inputs.settings.ao);
    const Scissor near_own_image(plan.guard_band_px, targets.size(), {reach, reach}, plan.upsample);
    draw_occlusion(commands, "ao", timers,
                   plan.upsample ? targets.half_ao_framebuffer() : targets.ao_framebuffer(plan.share ? 1 : 0));
  }
  glViewport(0, 0, targets.size().width, targets.size().height);
  return plan.upsample ? upsample(plan, commands, inputs.settings.ao, targets, timers) : Status();
}

Status FramePasses::upsample(const FramePlan& plan, const CommandList& commands, const AoSettings& ao,
                             const Targets& targets, PassTimers& timers) {
  LFD_TRY(const GLuint name, program({"passes/layers.vert", "passes/ao_upsample.frag"}, flags_of(plan)));
  glUseProgram(name);
  glBindTextureUnit(UNIT_NORMAL, targets.normal());
  glBindTextureUnit(UNIT_AO, targets.half_ao());
  const int reach = reach_of_blur(ao);
  const Scissor near_own_image(plan.guard_band_px, targets.size(), {reach, reach});
  draw_occlusion(commands, "ao_upsample", timers, targets.ao_framebuffer(plan.share ? 1 : 0));
  return {};
}

Status FramePasses::share(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs,
                          const Targets& targets, PassTimers& timers) {
  gl::Flags flags = flags_of(plan, inputs.modules.map_flags);
  if (inputs.modules.warp_tables) flags.emplace_back("WARP_TABLE");
  LFD_TRY(const GLuint name, program({"passes/layers.vert", "passes/ao_share.frag"}, flags));
  glUseProgram(name);
  glBindTextureUnit(UNIT_POSITION, targets.position());
  glBindTextureUnit(UNIT_NORMAL, targets.normal());
  glBindTextureUnit(UNIT_AO, targets.ao(1));
  const int reach = reach_of_blur(inputs.settings.ao);
  const Scissor near_own_image(plan.guard_band_px, targets.size(), {reach, reach});
  draw_occlusion(commands, "share", timers, targets.ao_framebuffer(0));
  return {};
}

Status FramePasses::blur(const FramePlan& plan, const CommandList& commands, const AoSettings& ao,
                         const Targets& targets, PassTimers& timers) {
  const bool is_gaussian = ao.blur == AoBlur::kGaussian;
  const char* fragment = is_gaussian ? "passes/blur.frag" : "passes/blur_geometry.frag";
  LFD_TRY(const GLuint name, program({"passes/layers.vert", fragment}, flags_of(plan)));
  glUseProgram(name);
  if (!is_gaussian || plan.bent) glBindTextureUnit(UNIT_NORMAL, targets.normal());
  if (is_gaussian) {
    const auto weights = gaussian_weights(ao.blur_sigma_px);
    glUniform1i(kBlurTaps, static_cast<GLint>(weights.size()) - 1);
    glUniform1fv(kBlurWeights, static_cast<GLsizei>(weights.size()), weights.data());
  } else {
    glUniform1i(kBlurTaps, ao.blur_taps);
    glBindTextureUnit(UNIT_POSITION, targets.position());
  }
  for (int i = 0; i < 2; ++i) {
    glBindTextureUnit(UNIT_AO, targets.ao(i));
    glUniform2i(kBlurDirection, i == 0 ? 1 : 0, i == 0 ? 0 : 1);
    const Scissor near_own_image(plan.guard_band_px, targets.size(), {0, i == 0 ? reach_of_blur(ao) : 0});
    draw_occlusion(commands, i == 0 ? "blur_horizontal" : "blur_vertical", timers, targets.ao_framebuffer(1 - i));
  }
  return {};
}

}  // namespace lfd
