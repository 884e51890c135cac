// Timing settings of ambient occlusion against a budget, on the node's own GPU.
#include <algorithm>

#include "base/log.h"
#include "proto/occlusion/front.h"
#include "proto/state.h"
#include "rendernode/plan/occlusion_choice.h"
#include "rendernode/renderer.h"

namespace lfd {
namespace {

constexpr int kTimedFrames = 3;  // the median of them counts

double milliseconds_of(const std::vector<TimedPass>& passes) {
  double sum = 0;
  for (const TimedPass& pass : passes) {
    if (is_occlusion_pass(pass.pass) || is_blur_pass(pass.pass)) sum += pass.gpu_ms;
  }
  return sum;
}

}  // namespace

Status Renderer::choose_occlusion(const FrameOptions& options) {
  const proto::AmbientOcclusion& asked = state_->render().ao();
  occlusion_choice_.clear();
  if (!(asked.budget_ms() > 0) || settings_.pattern.is_shown()) return {};
  if (!asked.method().empty()) {
    occlusion_choice_ =
        fmt::format("{}: it is asked for by name, whatever the budget of {:g} ms", asked.method(), asked.budget_ms());
    return {};
  }
  if (!chosen_ || !same_message(chosen_->asked, asked)) {
    FrameOptions timed = options;
    timed.time_modules = timed.reuse = timed.read_back = false;
    if (!plan(timed).ao) return {};  // nothing is drawn: nothing to time
    LFD_TRY_STATUS(time_candidates(asked, timed));
  }
  settings_.ao = chosen_->ao;
  occlusion_choice_ = chosen_->why;
  return {};
}

Status Renderer::time_candidates(const proto::AmbientOcclusion& asked, const FrameOptions& timed) {
  const AoSettings before = settings_.ao;
  OcclusionChoice choice(occlusion::committed_front(), asked, static_cast<int>(modules_.size()));
  while (const auto ao = choice.next()) {
    settings_.ao = *ao;
    const auto ms = time_occlusion(timed);
    settings_.ao = before;
    if (!ms) return ms.error();
    choice.took(*ms);
  }
  OcclusionChoice::Chosen found = choice.chosen();
  log::info("ambient occlusion: {}", found.why);
  chosen_ = ChosenOcclusion{asked, std::move(found.ao), std::move(found.why)};
  return {};
}

// One frame that is not counted, since shaders are compiled in it, then a few.
Result<double> Renderer::time_occlusion(const FrameOptions& timed) {
  std::vector<double> times;
  for (int frame = -1; frame < kTimedFrames; ++frame) {
    PassTimers timers;
    LFD_TRY_STATUS(submit(timed, timers));
    const double ms = milliseconds_of(timers.collect());
    if (frame >= 0) times.push_back(ms);
  }
  std::ranges::sort(times);
  return times[times.size() / 2];
}

}  // namespace lfd
