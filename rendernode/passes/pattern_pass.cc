// The pass of test patterns.
#include "rendernode/passes/frame_passes.h"

#include <array>

namespace lfd {
namespace {

static_assert(static_cast<int>(PatternKind::kNone) == PATTERN_BLACK);
static_assert(static_cast<int>(PatternKind::kNumber) == PATTERN_NUMBER);
static_assert(static_cast<int>(PatternKind::kGrid) == PATTERN_GRID);
static_assert(static_cast<int>(PatternKind::kChecker) == PATTERN_CHECKER);
static_assert(static_cast<int>(PatternKind::kSolid) == PATTERN_SOLID);

shared::PatternParams params_of(const PatternSettings& pattern, ScreenSize screen) {
  const double spacing_m = pattern.spacing_m > 0 ? pattern.spacing_m : 0.1 * screen.height_m;
  const double spacing = pattern.on_screen ? spacing_m : pattern.spacing_px;
  return {{static_cast<int>(pattern.kind), spacing, pattern.on_screen ? 1 : 0, 0}, glm::vec4(pattern.color, 0)};
}

}  // namespace

// The albedo is the picture where no post pass follows; it takes bytes as they are while sRGB is off.
Status FramePasses::patterns(const FramePlan& plan, const CommandList& commands, const FrameInputs& inputs,
                             const Targets& targets, PassTimers& timers) {
  std::vector<shared::PatternParams> params(MODULES_PER_NODE);  // black
  for (const std::uint32_t layer : plan.pattern_layers)
    params[layer] = params_of(inputs.settings.pattern, inputs.display.screen);
  patterns_ = gl::make_buffer(params);
  glBindBufferBase(GL_UNIFORM_BUFFER, BINDING_PATTERNS, patterns_.name());
  gl::Flags flags = inputs.modules.map_flags;
  if (inputs.modules.has_tables()) flags.emplace_back("PIXEL_TABLE");
  LFD_TRY(const GLuint name, program({"passes/layers.vert", "passes/pattern.frag"}, flags));
  glUseProgram(name);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, targets.geometry(plan));
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  // Where nothing was drawn before, llvmpipe's timer queries count from the start of the machine.
  constexpr std::array<float, 4> kBlack{0, 0, 0, 1};
  glClearNamedFramebufferfv(targets.geometry(plan), GL_COLOR, 0, kBlack.data());
  draw_layers(commands, "pattern", timers);
  glEnable(GL_FRAMEBUFFER_SRGB);
  return {};
}

}  // namespace lfd
