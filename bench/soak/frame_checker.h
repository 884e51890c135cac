// Judges whether a shown frame is of one state: every update paints the background in another colour, every scene has a
// colour of its own, and every module that is not stale must have both of the state that its frame was begun with.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "proto/scene.pb.h"
#include "proto/settings.pb.h"

namespace lfd::bench {

using Rgb8 = std::array<std::uint8_t, 3>;

// The n-th of 343 colours of which no two are alike, as settings have it (linear light) and as a module without a
// colour calibration is fed it (sRGB).
proto::Color background_of(std::uint64_t n);
Rgb8 shown_background_of(std::uint64_t n);

// From now on what is made of the scene's last material is of this colour (sRGB) alone: without texture, light or
// occlusion.
void give_own_color(proto::Scene& scene, const Rgb8& color);

// Told what is published, in its order.
class FrameChecker {
 public:
  static constexpr std::size_t kRemembered = 4096;  // frames and states

  // Another controller, or the first: nothing is known.
  void restarted();
  // The state of this sequence has this background; from now on, until the next one.
  void background(std::uint64_t sequence, const proto::Color& color);
  // Likewise this scene, which has been given its own colour; of one that has not no frame is judged.
  void scene(std::uint64_t sequence, const proto::Scene& scene);
  void begun(std::uint64_t frame, std::uint64_t sequence);
  void swapped(std::uint64_t frame, std::set<std::uint32_t> stale_modules);

  // A pixel of a module's picture that shows the background, and one that shows what has the scene's own colour.
  struct Pixels {
    Rgb8 background, scene;
  };
  struct Verdict {
    int fresh = 0;                    // modules that are not stale
    int wrong = 0;                    // of those, such as have another colour than their frame's
    std::vector<std::string> errors;  // a line for each of the wrong
  };
  // Of the modules that the frame has pictures of. Absent where the frame is not known to have been swapped, or its
  // state not known.
  std::optional<Verdict> judge(std::uint64_t frame, const std::map<std::uint32_t, Pixels>& seen) const;

  std::optional<std::uint64_t> last_swapped() const { return last_swapped_; }

 private:
  std::map<std::uint64_t, std::optional<Rgb8>> background_, scene_;  // by sequence
  std::map<std::uint64_t, std::uint64_t> sequence_;
  std::map<std::uint64_t, std::set<std::uint32_t>> stale_;
  std::optional<std::uint64_t> last_swapped_;
};

}  // namespace lfd::bench
