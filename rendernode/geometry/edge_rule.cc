// The rule for edges.
#include "rendernode/geometry/edge_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <utility>

namespace lfd {
namespace {

constexpr int kSlices = 64;
constexpr double kAlongFactor = 20;
constexpr double kBendMargin = 2;     // the bend is sampled, not proven
constexpr double kUnseenEdge = 0.25;  // of the screen's width: shorter edges that seem out of sight are believed to be
constexpr double kImageMargin_px = 2;
constexpr double kScreenMargin = 1.1;  // edges this far beside the screen cannot be seen

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Both ends beside the same border of the screen: nothing of the edge is seen, straight or not.
bool beside(ScreenSize screen, ScreenPoint a, ScreenPoint b) {
  const double x = kScreenMargin * 0.5 * screen.width_m, y = kScreenMargin * 0.5 * screen.height_m;
  return (a.x > x && b.x > x) || (a.x < -x && b.x < -x) || (a.y > y && b.y > y) || (a.y < -y && b.y < -y);
}

// Smallest and largest pixel coordinates along an edge.
struct Extent {
  glm::dvec2 low{kInfinity}, high{-kInfinity};

  void take(glm::dvec2 pixel) {
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  // All of it is beside the same border of the image.
  bool is_beside(ImageSize image, double margin_px) const {
    return high.x < -margin_px || high.y < -margin_px || low.x > image.width + margin_px ||
           low.y > image.height + margin_px;
  }
};

}  // namespace

EdgeRule::EdgeRule(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules,
                   const WarpTables& tables, const DepthLimits& limits, double tolerance_px)
    : display_(&display), limits_(limits), tolerance_px_(tolerance_px) {
  for (std::size_t i = 0; i < modules.size(); ++i) {
    const auto& table = tables.of_module[i];
    const ModuleCalibration& module = display.modules[modules[i]];
    maps_.emplace_back(display, module, table ? &*table : nullptr);
    emitters_.push_back(module.emitter);
  }
  measure_bend();
}

EdgeRule::Deviation EdgeRule::deviation_in(const ClipMap& map, Point3<Physical> a, Point3<Physical> b) const {
  const bool is_short = length(b - a) <= kUnseenEdge * display_->screen.width_m;
  const auto clip_a = map.clip_from_physical(a), clip_b = map.clip_from_physical(b);
  if (!clip_a && !clip_b) {
    // On a curved screen the middle of an edge may be seen between two ends that have no ray.
    return {map.is_curved() && !is_short ? kInfinity : 0, false};
  }
  if (!clip_a || !clip_b) return {kInfinity, false};
  const glm::dvec2 edge = glm::dvec2(*clip_b) / clip_b->z - glm::dvec2(*clip_a) / clip_a->z;
  const double edge_px = glm::length(edge);
  const glm::dvec2 along = edge_px > 0 ? edge / edge_px : glm::dvec2(1, 0);
  double worst = 0, farthest_px = 0;
  Extent extent;
  extent.take(glm::dvec2(*clip_a) / clip_a->z);
  extent.take(glm::dvec2(*clip_b) / clip_b->z);
  for (const double t : {0.5, 0.25, 0.75}) {
    const Point3<Physical> p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
    const auto truly = map.clip_from_physical(p);
    if (!truly) return {kInfinity, false};
    const ClipPoint drawn = (1 - t) * *clip_a + t * *clip_b;
    const glm::dvec2 pixel = glm::dvec2(*truly) / truly->z, off = pixel - glm::dvec2(drawn) / drawn.z;
    extent.take(pixel);
    farthest_px = std::max(farthest_px, glm::length(off));
    const double beside_px = std::abs(off.x * along.y - off.y * along.x);
    worst = std::max({worst, beside_px, std::abs(glm::dot(off, along)) / kAlongFactor});
  }
  // Beside the image by more than it bends: it is not seen, and need not be true. (A lens may throw all but the middle
  // of the screen far beside its image, stretched a million times.)
  return {worst / tolerance_px_, is_short && extent.is_beside(display_->image, farthest_px + kImageMargin_px)};
}

double EdgeRule::beside_m() const {
  constexpr double kCornerGrid_px = 1.0 / 128;  // OpenGL promises 1/16 of a pixel; all that are known have 1/256
  const double pitch_m =
      std::max(display_->screen.width_m / display_->image.width, display_->screen.height_m / display_->image.height);
  return (tolerance_px_ + kCornerGrid_px) * pitch_m;
}

bool EdgeRule::is_beside(const ClipMap& map, Point3<Physical> a, Point3<Physical> b) const {
  const auto at_a = map.screen_from_physical(a), at_b = map.screen_from_physical(b);
  return at_a && at_b && beside(display_->screen, at_a->at, at_b->at);
}

double EdgeRule::seen_deviation(const ClipMap& map, Point3<Physical> a, Point3<Physical> b) const {
  if (is_beside(map, a, b)) return 0;
  const Deviation found = deviation_in(map, a, b);
  return found.is_beside_image ? 0 : found.tolerances;
}

double EdgeRule::deviation(Point3<Physical> a, Point3<Physical> b) const {
  double worst = 0;
  for (const auto& map : maps_) worst = std::max(worst, seen_deviation(map, a, b));
  return worst;
}

double EdgeRule::bend_between(double z0, double z1) const {
  const auto slice = [&](double z) {
    const auto above = std::upper_bound(border_.begin() + 1, border_.end() - 1, z);
    return above - border_.begin() - 1;
  };
  const auto [low, high] = std::minmax({slice(z0), slice(z1)});
  return *std::max_element(bend_.begin() + low, bend_.begin() + high + 1);
}

bool EdgeRule::must_split(Point3<Physical> a, Point3<Physical> b) const {
  // One order for both triangles that share the edge: rounding must not make them differ.
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
  const Vector3<Physical> d = b - a;
  if (bend_between(a.z, b.z) * dot(d, d) <= 1) return false;
  return std::ranges::any_of(maps_, [&](const ClipMap& map) { return seen_deviation(map, a, b) > 1; });
}

// Even steps of log((vz - z) / (z - singular)): however far the emitters stand, the space about the screen has many.
void EdgeRule::lay_slices() {
  const double vz = display_->optics.observer_distance_m, singular = limits_.singular;
  const auto place = [&](double z) { return std::log((vz - z) / (z - singular)); };
  const double first = place(limits_.back), last = place(limits_.front);
  for (int i = 0; i <= kSlices; ++i) {
    const double ratio = std::exp(first + (last - first) * i / kSlices);
    border_.push_back((vz + ratio * singular) / (1 + ratio));
  }
}

// Both borders of each slice count, so that the steepest place of it is among the samples.
void EdgeRule::measure_bend() {
  lay_slices();
  std::vector<double> at_border;
  for (const double z : border_) at_border.push_back(kBendMargin * steepest_bend_at(z));
  for (int i = 0; i < kSlices; ++i) {
    const auto slice = static_cast<std::size_t>(i);
    bend_.push_back(std::max(at_border[slice], at_border[slice + 1]));
  }
}

double EdgeRule::steepest_bend_at(double z) const {
  constexpr std::array<double, 5> kPlaces{-1.1, -0.6, 0, 0.6, 1.1};
  constexpr std::array<std::array<double, 3>, 7> kDirections{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.7, 0.7, 0}, {0, 0.7, 0.7}, {0.7, 0, 0.7}, {0.58, -0.58, 0.58}}};
  const double vz = display_->optics.observer_distance_m;
  const double step = 1e-3 * std::min(vz - z, z - limits_.singular);
  double steepest = 0;
  for (std::size_t k = 0; k < maps_.size(); ++k) {
    const Emitter emitter = emitters_[k];
    for (const double x : kPlaces) {
      for (const double y : kPlaces) {
        // The point at height z that this screen point shows (for a conical diffuser roughly, which is enough).
        const double spread = (z - emitter.z) / -emitter.z;
        const double sx = 0.5 * display_->screen.width_m * x;
        const Point3<Physical> p{emitter.x + (sx - emitter.x) * spread,
                                 0.5 * display_->screen.height_m * y * (1 - z / vz), z};
        for (const auto& d : kDirections) {
          const Vector3<Physical> v{step * d[0], step * d[1], step * d[2]};
          const double found = deviation_in(maps_[k], p, p + v).tolerances;
          if (std::isfinite(found)) steepest = std::max(steepest, found / dot(v, v));
        }
      }
    }
  }
  return steepest;
}

}  // namespace lfd
