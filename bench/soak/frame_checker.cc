// Colours by state.
#include "bench/soak/frame_checker.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/srgb.h"

namespace lfd::bench {
namespace {

constexpr int kLevels = 7;
constexpr int kTolerance = 3;  // of 255: two roundings; two colours differ by more than 30 in a channel

// Levels are apart in sRGB, where they are compared.
std::uint8_t byte_of(std::uint64_t level) { return static_cast<std::uint8_t>(20 + 35 * level); }

Rgb8 shown(const proto::Color& color) {
  const auto byte = [](double linear) {
    return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(std::clamp(linear, 0.0, 1.0))));
  };
  return {byte(color.r()), byte(color.g()), byte(color.b())};
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

proto::Color background_of(std::uint64_t n) {
  const Rgb8 bytes = shown_background_of(n);
  proto::Color color;
  color.set_r(static_cast<float>(linear_from_srgb(bytes[0] / 255.0)));
  color.set_g(static_cast<float>(linear_from_srgb(bytes[1] / 255.0)));
  color.set_b(static_cast<float>(linear_from_srgb(bytes[2] / 255.0)));
  return color;
}

void FrameChecker::restarted() { *this = {}; }

void FrameChecker::background(std::uint64_t sequence, const proto::Color& color) {
  background_[sequence] = shown(color);
  forget_oldest(background_, kRemembered);
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
                                                         const std::map<std::uint32_t, Rgb8>& seen) const {
  const auto begun = sequence_.find(frame);
  const auto swapped = stale_.find(frame);
  if (begun == sequence_.end() || swapped == stale_.end()) return std::nullopt;
  auto of_state = background_.upper_bound(begun->second);
  if (of_state == background_.begin()) return std::nullopt;
  --of_state;
  Verdict verdict;
  for (const auto& [module, color] : seen) {
    if (swapped->second.contains(module)) continue;
    ++verdict.fresh;
    if (!alike(color, of_state->second)) ++verdict.wrong;
  }
  return verdict;
}

}  // namespace lfd::bench
