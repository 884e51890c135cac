// Draws every rung at one place with one radius: its times in turn with the others', and what it shows.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/ao/consistency.h"
#include "bench/ao/ladder.h"
#include "bench/ao/place.h"
#include "rendernode/renderer.h"

namespace lfd::bench {

// What was seen of one rung. Times are of one module: the mean of both that are judged.
struct Measurement {
  int layers = 0;                    // modules drawn together
  std::vector<double> occlusion_ms;  // by frame: all passes up to where occlusion is known for every pixel; GPU timers
  std::vector<double> blur_ms;       // both directions
  std::vector<double> ratio;         // occlusion_ms over that of the yardstick in the same round
  Openness open;                     // after the blur, before the curve
  Openness beside;                   // the same of the next module; empty where there is none
};

// Draws the modules of one place: the judged one and the next, or all neighbours that sharing asks for.
class PlaceRenderers {
 public:
  // All outlive the object. The module must be one of the display's.
  PlaceRenderers(const gl::Context& context, const ShownScene& scene, std::uint32_t module)
      : context_(context), scene_(scene), module_(module) {}

  // The next module, whose pictures are compared with the judged one's; the one before for the last; absent where there
  // is no other.
  std::optional<std::uint32_t> beside() const;

  // What part of a frame's time one judged module has: of passes that do the same for all, and of sharing.
  struct Parts {
    double even = 1, of_sharing = 0;
  };
  Parts parts(const proto::AmbientOcclusion& ao);

  const gl::Context& context() const { return context_; }

  // One frame. Errors: settings, the driver.
  Result<FrameResult> draw(const proto::AmbientOcclusion& ao, const BufferSet& buffers, bool read_back);
  // How many modules it draws.
  int layers(const proto::AmbientOcclusion& ao);

  // Where both modules show the same surface.
  Result<std::vector<SharedPoint>> shared_points();

 private:
  Renderer& renderer(int neighbours);

  const gl::Context& context_;
  const ShownScene& scene_;
  std::uint32_t module_;
  std::map<int, std::unique_ptr<Renderer>> of_neighbours_;
};

struct MeasureOptions {
  double radius_m = 0;
  int frames = 5;       // of each rung, in turn; one of those that take more than kSlow_ms
  bool resume = false;  // takes what `cache` has of the same program, device and rungs
  std::filesystem::path cache;
};
inline constexpr double kSlow_ms = 2000;  // wall clock of a frame of all modules that are drawn

// In the order of the rungs. Every round begins with the yardstick: `sphere` as it comes. The result is kept in the
// cache.
Result<std::vector<Measurement>> measure(PlaceRenderers& renderers, const ShownScene& scene, std::uint32_t module,
                                         const std::vector<Rung>& rungs, const MeasureOptions& options);

}  // namespace lfd::bench
