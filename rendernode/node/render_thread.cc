// Jobs in, frames out; the next frame is submitted before the last one is packed.
#include "rendernode/node/render_thread.h"

#include <chrono>
#include <utility>

#include "base/log.h"

namespace lfd::node {
namespace {

using namespace std::chrono_literals;

// How long a finished frame waits for the next job, so that the GPU has work while its images are packed.
constexpr auto kNextJobPatience = 2ms;

}  // namespace

RenderThread::RenderThread(int gpu, DisplayCalibration display, std::vector<std::uint32_t> modules)
    : thread_([this, gpu, display = std::move(display), modules = std::move(modules)]() mutable {
        run(gpu, std::move(display), std::move(modules));
      }) {}

RenderThread::~RenderThread() {
  stop_ = true;
  jobs_.close();
  events_.close();
  if (thread_.joinable()) thread_.join();
}

std::optional<FrameEvent> RenderThread::take() {
  auto event = events_.take();
  if (event && event->kind == FrameEvent::Kind::kReady) --pending_;
  return event;
}

bool RenderThread::stop_within(Clock::duration patience) {
  stop_ = true;
  jobs_.close();
  const auto until = Clock::now() + patience;
  while (!ended_ && Clock::now() < until) std::this_thread::sleep_for(5ms);
  return ended_;
}

void RenderThread::say(FrameEvent event) {
  // Full only when nobody listens any more; then what is said does not matter.
  if (!events_.put(std::move(event))) log::debug("a frame event finds no listener");
}

void RenderThread::run(int gpu, DisplayCalibration display, std::vector<std::uint32_t> modules) {
  auto context = gl::Context::create(gpu);
  if (!context) {
    say({FrameEvent::Kind::kFailed, 0, {}, context.error().message()});
    ended_ = true;
    return;
  }
  log::info("draws {} modules with {}", modules.size(), (*context)->description());
  {
    Renderer renderer(**context, std::move(display), std::move(modules));
    say({FrameEvent::Kind::kStarted, 0, {}, {}});
    loop(renderer);
  }
  ended_ = true;
}

void RenderThread::loop(Renderer& renderer) {
  while (!stop_) {
    if (under_way_.empty()) {
      if (auto job = jobs_.take_within(50ms)) begin(renderer, std::move(*job));
      continue;
    }
    if (!renderer.finished(20ms)) continue;
    say({FrameEvent::Kind::kDrawn, under_way_.front(), {}, {}});
    if (auto job = jobs_.take_within(kNextJobPatience)) begin(renderer, std::move(*job));
    finish(renderer);
  }
}

// A frame whose state cannot be drawn is ready without images; its report says why, and its modules keep what they
// show.
void RenderThread::begin(Renderer& renderer, DrawJob job) {
  ++pending_;
  FrameOptions options;
  options.buffers.bits = job.state->buffers();
  options.time_modules = job.time_modules;
  options.reuse = !job.time_modules;
  Status drawn = renderer.set_state(*job.state, *job.assets);
  if (drawn) drawn = renderer.draw(options);
  if (drawn) {
    under_way_.push_back(job.frame);
    return;
  }
  log::error("frame {}: {}", job.frame, drawn.error().message());
  FrameResult nothing;
  nothing.report.set_error(drawn.error().message());
  say({FrameEvent::Kind::kDrawn, job.frame, {}, {}});
  say({FrameEvent::Kind::kReady, job.frame, std::move(nothing), {}});
}

void RenderThread::finish(Renderer& renderer) {
  FrameResult result = renderer.collect();
  const std::uint64_t frame = under_way_.front();
  under_way_.pop_front();
  say({FrameEvent::Kind::kReady, frame, std::move(result), {}});
}

}  // namespace lfd::node
