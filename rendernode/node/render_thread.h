// The thread that owns the GL context: takes jobs, draws, hands finished frames back, and starts anew where the GPU was
// reset.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "calibration/display.h"
#include "proto/wire/mailbox.h"
#include "rendernode/renderer.h"

namespace lfd::node {

inline constexpr std::uint64_t kForNobody = 0;  // an epoch

struct DrawJob {
  std::uint64_t frame = 0;
  std::uint64_t epoch = kForNobody;  // given back with the frame's events: whoever asked may have joined anew since
  std::shared_ptr<const proto::State> state;
  std::shared_ptr<const Assets> assets;
  bool time_modules = false;
};

struct FrameEvent {
  enum class Kind {
    kStarted,  // the context is there (again)
    kDrawn,    // the GPU is done with the frame
    kReady,    // its images are in hand
    kFailed,   // there will be no more frames: `error`
  };
  Kind kind = Kind::kStarted;
  std::uint64_t frame = 0;
  std::uint64_t epoch = 0;            // of the job
  std::optional<FrameResult> result;  // kReady
  std::string error;
};

class RenderThread {
 public:
  RenderThread(int gpu, DisplayCalibration display, std::vector<std::uint32_t> modules);
  // Ends after the frame under way.
  ~RenderThread();

  // False where too many jobs wait already.
  bool draw(DrawJob job) {
    ++pending_;
    const bool fits = jobs_.put(std::move(job));
    if (!fits) --pending_;
    return fits;
  }

  // Frames given in and not yet ready.
  int pending() const { return pending_; }
  std::optional<FrameEvent> take();
  int descriptor() const { return events_.descriptor(); }

  // How long it has worked without bringing anything to an end: a driver that hangs never comes back.
  Clock::duration stuck_for(Clock::time_point now) const;

  // Asks it to end. True once it has; a driver call cannot be interrupted, so it may take as long as a frame.
  bool stop_within(Clock::duration patience);

 private:
  enum class End { kStopped, kLost, kFailed };

  void run(int gpu, const DisplayCalibration& display, const std::vector<std::uint32_t>& modules);
  // Until it is asked to end or its context is lost.
  End draw_with_a_context(int gpu, const DisplayCalibration& display, const std::vector<std::uint32_t>& modules);
  End loop(gl::Context& context, Renderer& renderer);
  void give_up_frames(const std::string& why);
  void say_undrawn(std::uint64_t frame, std::uint64_t epoch, const std::string& why);
  void begin(Renderer& renderer, const DrawJob& job);
  void finish(Renderer& renderer);
  void say(FrameEvent event);
  void gets_on() { last_progress_ = Clock::now(); }

  struct UnderWay {
    std::uint64_t frame = 0, epoch = 0;
    Clock::time_point begun;
  };
  std::deque<UnderWay> under_way_;  // frames submitted and not yet collected
  int lost_in_a_row_ = 0;           // contexts, without a frame between them
  wire::Mailbox<DrawJob> jobs_{8};
  wire::Mailbox<FrameEvent> events_{64};
  std::atomic<bool> stop_{false}, ended_{false};
  std::atomic<int> pending_{0};
  std::atomic<Clock::time_point> last_progress_{Clock::now()};
  std::thread thread_;
};

}  // namespace lfd::node
