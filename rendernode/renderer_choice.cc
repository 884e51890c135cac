// Timing settings of ambient occlusion against a budget, on the node's own GPU.
#include <algorithm>

#include "base/log.h"
#include "proto/occlusion/front.h"
#include "rendernode/plan/occlusion_choice.h"
#include "rendernode/renderer.h"

namespace lfd {
namespace {

constexpr FrameOptions kOnlyDraw{.buffers = {}, .time_modules = false, .reuse = false, .read_back = false};
constexpr int kTimedFrames = 3;  // the median of them counts

double occlusion_ms_of(const std::vector<TimedPass>& passes) {
  double sum = 0;
  for (const TimedPass& pass : passes) {
    const std::string& name = pass.pass;
    if (name == "pyramid" || name == "ao" || name == "ao_upsample" || name == "share" || name.starts_with("blur"))
      sum += pass.gpu_ms;
  }
  return sum;
}

}  // namespace

Status Renderer::choose_occlusion() {
  const proto::AmbientOcclusion& asked = state_->render().ao();
  occlusion_choice_.clear();
  if (asked.budget_ms() > 0 && !asked.method().empty()) {
    occlusion_choice_ =
        fmt::format("{}: it is asked for by name, whatever the budget of {:g} ms", asked.method(), asked.budget_ms());
    return {};
  }
  if (!settings_.ao.is_chosen_by_budget() || !plan(kOnlyDraw).ao) return {};  // nothing is drawn: nothing to time
  const std::string key = asked.SerializeAsString();
  if (!chosen_ || chosen_->key != key) {
    OcclusionChoice choice(occlusion::committed_front(), asked, static_cast<int>(modules_.size()));
    while (const auto ao = choice.next()) {
      settings_.ao = *ao;
      LFD_TRY(const double ms, time_occlusion(4 * asked.budget_ms()));
      choice.took(ms);
    }
    OcclusionChoice::Chosen found = choice.chosen();
    log::info("ambient occlusion: {}", found.why);
    chosen_ = ChosenOcclusion{key, std::move(found.ao), std::move(found.why)};
  }
  settings_.ao = chosen_->ao;
  occlusion_choice_ = chosen_->why;
  return {};
}

// One frame that is not counted, since shaders are compiled in it, then a few, fewer where one is far too slow anyway.
Result<double> Renderer::time_occlusion(double far_too_slow_ms) {
  std::vector<double> times;
  for (int frame = -1; frame < kTimedFrames; ++frame) {
    PassTimers timers;
    LFD_TRY_STATUS(submit(kOnlyDraw, timers));
    const double ms = occlusion_ms_of(timers.collect());
    if (frame >= 0) times.push_back(ms);
    if (frame >= 0 && ms > far_too_slow_ms) break;
  }
  std::ranges::sort(times);
  return times[times.size() / 2];
}

}  // namespace lfd
