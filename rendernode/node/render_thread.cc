// Jobs in, frames out; the next frame is submitted before the last one is packed.
#include "rendernode/node/render_thread.h"

#include <chrono>
#include <utility>

#include "base/fault.h"
#include "base/log.h"

namespace lfd::node {
namespace {

using namespace std::chrono_literals;

// How long a finished frame waits for the next job, so that the GPU has work while its images are packed.
constexpr auto kNextJobPatience = 2ms;
constexpr int kMostLosses = 3;  // of contexts without a frame drawn between them; then the GPU is of no use

}  // namespace

RenderThread::RenderThread(int gpu, DisplayCalibration display, std::vector<std::uint32_t> modules)
    : thread_([this, gpu, display = std::move(display), modules = std::move(modules)] { run(gpu, display, modules); }) {
}

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

Clock::duration RenderThread::stuck_for(Clock::time_point now) const {
  return ended_ ? Clock::duration::zero() : now - last_progress_.load();
}

void RenderThread::say(FrameEvent event) {
  // Full only when nobody listens any more; then what is said does not matter.
  if (!events_.put(std::move(event))) log::debug("a frame event finds no listener");
}

void RenderThread::run(int gpu, const DisplayCalibration& display, const std::vector<std::uint32_t>& modules) {
  while (!stop_) {
    gets_on();
    if (draw_with_a_context(gpu, display, modules) != End::kLost) break;
    give_up_frames("the GL context was lost");
    if (++lost_in_a_row_ <= kMostLosses) continue;
    say({FrameEvent::Kind::kFailed,
         0,
         0,
         {},
         fmt::format("the GL context was lost {} times in a row", lost_in_a_row_)});
    break;
  }
  ended_ = true;
}

RenderThread::End RenderThread::draw_with_a_context(int gpu, const DisplayCalibration& display,
                                                    const std::vector<std::uint32_t>& modules) {
  auto context = gl::Context::create(gpu);
  if (!context) {
    say({FrameEvent::Kind::kFailed, 0, 0, {}, context.error().message()});
    return End::kFailed;
  }
  log::info("draws {} modules with {}", modules.size(), (*context)->description());
  Renderer renderer(**context, display, modules);
  say({FrameEvent::Kind::kStarted, 0, 0, {}, {}});
  return loop(**context, renderer);
}

RenderThread::End RenderThread::loop(gl::Context& context, Renderer& renderer) {
  while (!stop_) {
    if (under_way_.empty()) {
      gets_on();
      if (auto job = jobs_.take_within(50ms)) begin(renderer, *job);
      if (context.is_lost()) return End::kLost;
      continue;
    }
    const UnderWay oldest = under_way_.front();
    if (fault::due("lose-context", fault::kDrawing, oldest.frame)) context.lose();
    if (!renderer.finished(20ms) && !context.is_lost()) continue;
    if (context.is_lost()) return End::kLost;
    if (fault::slowdown() > 1 && oldest.epoch != kForNobody)
      std::this_thread::sleep_for((fault::slowdown() - 1) * (Clock::now() - oldest.begun));
    say({FrameEvent::Kind::kDrawn, oldest.frame, oldest.epoch, {}, {}});
    gets_on();
    if (auto job = jobs_.take_within(kNextJobPatience)) begin(renderer, *job);
    finish(renderer);
    gets_on();
    lost_in_a_row_ = 0;
  }
  return End::kStopped;
}

// A frame whose state cannot be drawn is ready without images; its report says why, and its modules keep what they
// show.
void RenderThread::begin(Renderer& renderer, const DrawJob& job) {
  fault::at(fault::kDrawing, job.frame);
  if (fault::due("hang", fault::kDrawing, job.frame)) std::this_thread::sleep_for(24h);
  FrameOptions options;
  options.buffers.bits = job.state->buffers();
  options.time_modules = job.time_modules;
  options.reuse = !job.time_modules;
  const auto begun = Clock::now();
  Status drawn = renderer.set_state(*job.state, *job.assets);
  if (drawn) drawn = renderer.draw(options);
  if (drawn) {
    under_way_.push_back({job.frame, job.epoch, begun});
    return;
  }
  say_undrawn(job.frame, job.epoch, drawn.error().message());
}

void RenderThread::say_undrawn(std::uint64_t frame, std::uint64_t epoch, const std::string& why) {
  if (epoch != kForNobody) log::error("frame {}: {}", frame, why);
  FrameResult nothing;
  nothing.report.set_error(why);
  say({FrameEvent::Kind::kDrawn, frame, epoch, {}, {}});
  say({FrameEvent::Kind::kReady, frame, epoch, std::move(nothing), {}});
}

void RenderThread::give_up_frames(const std::string& why) {
  for (const UnderWay& frame : under_way_) say_undrawn(frame.frame, frame.epoch, why);
  under_way_.clear();
}

void RenderThread::finish(Renderer& renderer) {
  FrameResult result = renderer.collect();
  const UnderWay done = under_way_.front();
  under_way_.pop_front();
  say({FrameEvent::Kind::kReady, done.frame, done.epoch, std::move(result), {}});
}

}  // namespace lfd::node
