// Colours by state.
#include "bench/soak/frame_checker.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/log.h"
#include "base/srgb.h"

namespace lfd::bench {
namespace {

constexpr std::uint64_t kLevels = 7;
constexpr int kTolerance = 3;  // of 255: two roundings; two colours differ by more than 30 in a channel

// Levels are apart in sRGB, where they are compared.
std::uint8_t byte_of(std::uint64_t level) { return static_cast<std::uint8_t>(20 + 35 * level); }

Rgb8 shown(const proto::Color& color) {
  const auto byte = [](double linear) {
    return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(std::clamp(linear, 0.0, 1.0))));
  };
  return {byte(color.r()), byte(color.g()), byte(color.b())};
}

proto::Color linear(const Rgb8& bytes) {
  proto::Color color;
  color.set_r(static_cast<float>(linear_from_srgb(bytes[0] / 255.0)));
  color.set_g(static_cast<float>(linear_from_srgb(bytes[1] / 255.0)));
  color.set_b(static_cast<float>(linear_from_srgb(bytes[2] / 255.0)));
  return color;
}

std::optional<Rgb8> own_color_of(const proto::Scene& scene) {
  if (scene.material().empty()) return std::nullopt;
  const proto::Material& own = *scene.material().rbegin();
  if (!own.unlit() || own.has_texture() || own.base_color_size() < 3) return std::nullopt;
  proto::Color color;
  color.set_r(own.base_color(0));
  color.set_g(own.base_color(1));
  color.set_b(own.base_color(2));
  return shown(color);
}

// What holds at this sequence.
std::optional<Rgb8> latest(const std::map<std::uint64_t, std::optional<Rgb8>>& by_sequence, std::uint64_t sequence) {
  const auto after = by_sequence.upper_bound(sequence);
  return after == by_sequence.begin() ? std::nullopt : std::prev(after)->second;
}

bool alike(const Rgb8& a, const Rgb8& b) {
  return std::ranges::equal(a, b, [](int x, int y) { return std::abs(x - y) <= kTolerance; });
}

template <class Map>
void forget_oldest(Map& map, std::size_t remembered) {
  while (map.size() > remembered) map.erase(map.begin());
}

}  // namespace

Rgb8 shown_background_of(std::uint64_t n) {
  return {byte_of(n % kLevels), byte_of(n / kLevels % kLevels), byte_of(n / (kLevels * kLevels) % kLevels)};
}

proto::Color background_of(std::uint64_t n) { return linear(shown_background_of(n)); }

void give_own_color(proto::Scene& scene, const Rgb8& color) {
  proto::Material& material = *scene.mutable_material()->rbegin();
  const proto::Color own = linear(color);
  material.clear_base_color();
  for (const double channel : {own.r(), own.g(), own.b(), 1.0}) material.add_base_color(static_cast<float>(channel));
  material.clear_texture();
  material.set_unlit(true);
}

void FrameChecker::restarted() { *this = {}; }

void FrameChecker::background(std::uint64_t sequence, const proto::Color& color) {
  background_[sequence] = shown(color);
  forget_oldest(background_, kRemembered);
}

void FrameChecker::scene(std::uint64_t sequence, const proto::Scene& scene) {
  scene_[sequence] = own_color_of(scene);
  forget_oldest(scene_, kRemembered);
}

void FrameChecker::begun(std::uint64_t frame, std::uint64_t sequence) {
  sequence_[frame] = sequence;
  forget_oldest(sequence_, kRemembered);
}

void FrameChecker::swapped(std::uint64_t frame, std::set<std::uint32_t> stale_modules) {
  stale_[frame] = std::move(stale_modules);
  forget_oldest(stale_, kRemembered);
  last_swapped_ = std::max(frame, last_swapped_.value_or(frame));
}

std::optional<FrameChecker::Verdict> FrameChecker::judge(std::uint64_t frame,
                                                         const std::map<std::uint32_t, Pixels>& seen) const {
  const auto begun = sequence_.find(frame);
  const auto swapped = stale_.find(frame);
  if (begun == sequence_.end() || swapped == stale_.end()) return std::nullopt;
  const auto background = latest(background_, begun->second), scene = latest(scene_, begun->second);
  if (!background || !scene) return std::nullopt;
  Verdict verdict;
  for (const auto& [module, pixels] : seen) {
    if (swapped->second.contains(module)) continue;
    ++verdict.fresh;
    if (alike(pixels.background, *background) && alike(pixels.scene, *scene)) continue;
    ++verdict.wrong;
    verdict.errors.push_back(
        fmt::format("frame {} of state {}, module {}: background {} instead of {}, scene {} "
                    "instead of {}",
                    frame, begun->second, module, fmt::join(pixels.background, " "), fmt::join(*background, " "),
                    fmt::join(pixels.scene, " "), fmt::join(*scene, " ")));
  }
  return verdict;
}

}  // namespace lfd::bench
