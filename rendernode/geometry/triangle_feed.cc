// Cutting, splitting and writing triangles.
#include "rendernode/geometry/triangle_feed.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <optional>

namespace lfd {
namespace {

constexpr std::uint32_t kNotWritten = std::numeric_limits<std::uint32_t>::max();
constexpr int kMostSplits = 10;  // halvings of one edge; by then a rule that is never content has met a singularity

std::optional<shared::PrimitivePlane> plane_of(Point3<Physical> a, Point3<Physical> b, Point3<Physical> c,
                                               double slack_m, double grazing) {
  const Vector3<Physical> n = cross(b - a, c - a);
  const double area2 = length(n);
  if (!(area2 > 0) || !std::isfinite(area2)) return std::nullopt;
  const Vector3<Physical> unit = (1 / area2) * n;
  const Point3<Physical> centre = {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3, (a.z + b.z + c.z) / 3};
  const double offset = dot(unit, centre - Point3<Physical>{});
  const auto [low, high] = std::minmax({a.z, b.z, c.z});
  // A barycentric coordinate grows from 0 on the side opposite to its corner.
  const Vector3<Physical> to_a = (1 / area2) * cross(unit, c - b), to_b = (1 / area2) * cross(unit, a - c);
  const double at_a = -dot(to_a, b - Point3<Physical>{}) + slack_m * length(to_a);
  const double at_b = -dot(to_b, c - Point3<Physical>{}) + slack_m * length(to_b);
  const double slacks = slack_m * (length(to_a) + length(to_b) + length(to_a + to_b));
  return shared::PrimitivePlane{{unit.x, unit.y, unit.z, offset},
                                {low, high, 1 + slacks, grazing * grazing},
                                {to_a.x, to_a.y, to_a.z, at_a},
                                {to_b.x, to_b.y, to_b.z, at_b}};
}

using Coordinate = double Point3<Physical>::*;
constexpr std::array<Coordinate, 3> kAxes{&Point3<Physical>::z, &Point3<Physical>::x, &Point3<Physical>::y};

bool reaches_beyond(const DepthLimits& limits, const std::array<Point3<Physical>, 3>& p) {
  return std::ranges::any_of(kAxes, [&](Coordinate axis) {
    const auto [low, high] = std::minmax({p[0].*axis, p[1].*axis, p[2].*axis});
    return low < limits.low.*axis || high > limits.high.*axis;
  });
}

// Keeps what lies on the side of `limit` to which `sign` points.
void cut(std::vector<Corner>& polygon, Coordinate axis, double limit, double sign) {
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& here = polygon[i];
    const Corner& next = polygon[(i + 1) % polygon.size()];
    const double inside_here = sign * (here.position.*axis - limit), inside_next = sign * (next.position.*axis - limit);
    if (inside_here >= 0) kept.push_back(here);
    if ((inside_here < 0) == (inside_next < 0)) continue;
    // From the same end whichever triangle asks, so that neighbours cut their edge at the same point.
    const bool forward = inside_here < 0;
    Corner crossing = forward ? between(here, next, inside_here / (inside_here - inside_next))
                              : between(next, here, inside_next / (inside_next - inside_here));
    crossing.position.*axis = limit;
    kept.push_back(crossing);
  }
  polygon = std::move(kept);
}

// The largest number of half precision stands for all beyond it.
std::uint16_t half_of(double value) {
  return glm::packHalf1x16(static_cast<float>(std::clamp(value, -65504.0, 65504.0)));
}

std::int16_t snorm_of(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0, 1.0) * 32767));
}

}  // namespace

Corner between(const Corner& a, const Corner& b, double t) {
  const auto mix = [t](double x, double y) { return x + t * (y - x); };
  return {{mix(a.position.x, b.position.x), mix(a.position.y, b.position.y), mix(a.position.z, b.position.z)},
          glm::mix(a.normal, b.normal, t),
          glm::mix(a.uv, b.uv, t),
          glm::mix(a.color, b.color, t)};
}

Corner middle_of(const Corner& a, const Corner& b) {
  return {midpoint(a.position, b.position), 0.5 * (a.normal + b.normal), 0.5 * (a.uv + b.uv),
          0.5 * (a.color + b.color)};
}

void TriangleFeed::begin_item(std::uint32_t material, std::vector<Corner> corners) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  item_ = {static_cast<std::uint32_t>(out_.indices.size()),
           0,
           static_cast<std::uint32_t>(out_.planes.size()),
           material,
           {kFar, kFar, kFar},
           {-kFar, -kFar, -kFar}};
  corners_ = std::move(corners);
  written_.assign(corners_.size(), kNotWritten);
  middles_.clear();
}

void TriangleFeed::add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  ++out_.source_triangles;
  const std::array<Point3<Physical>, 3> p{corners_[a].position, corners_[b].position, corners_[c].position};
  const auto plane = plane_of(p[0], p[1], p[2], slack_m_, grazing_);
  if (!plane) {
    ++out_.degenerate_triangles;
    return;
  }
  if (reaches_beyond(limits_, p)) {
    ++out_.cut_triangles;
    return add_cut({a, b, c}, *plane);
  }
  split({a, b, c}, *plane, 0);
}

// Sutherland-Hodgman against the sides of the box, then a fan.
void TriangleFeed::add_cut(const Triangle& triangle, const shared::PrimitivePlane& plane) {
  std::vector<Corner> polygon;
  for (const std::uint32_t corner : triangle) polygon.push_back(corners_[corner]);
  for (const Coordinate axis : kAxes) {
    cut(polygon, axis, limits_.high.*axis, -1);
    cut(polygon, axis, limits_.low.*axis, 1);
  }
  if (polygon.size() < 3) return;
  const std::uint32_t first = append(polygon[0]);
  std::uint32_t last = append(polygon[1]);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const std::uint32_t next = append(polygon[i]);
    split({first, last, next}, plane, 0);
    last = next;
  }
}

// Halves every edge that the rule names: 1, 2 or 3 of them give 2, 3 or 4 triangles.
void TriangleFeed::split(const Triangle& t, const shared::PrimitivePlane& plane, int depth) {
  std::array<bool, 3> halve{};
  int count = 0;
  for (std::size_t i = 0; i < 3 && depth < kMostSplits; ++i) {
    halve[i] = rule_.must_split(corners_[t[i]].position, corners_[t[(i + 1) % 3]].position);
    count += halve[i] ? 1 : 0;
  }
  if (count == 0) return emit(t, plane);
  if (count == 3) {
    const Triangle m{middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    split({t[0], m[0], m[2]}, plane, depth + 1);
    split({m[0], t[1], m[1]}, plane, depth + 1);
    split({m[2], m[1], t[2]}, plane, depth + 1);
    return split(m, plane, depth + 1);
  }
  // Turn the triangle so that edge 0 is halved and, of two, edge 1 as well.
  std::size_t turn = 0;
  while (!halve[turn] || (count == 2 && !halve[(turn + 1) % 3])) ++turn;
  const std::uint32_t a = t[turn], b = t[(turn + 1) % 3], c = t[(turn + 2) % 3];
  const std::uint32_t ab = middle(a, b);
  if (count == 1) {
    split({a, ab, c}, plane, depth + 1);
    return split({ab, b, c}, plane, depth + 1);
  }
  const std::uint32_t bc = middle(b, c);
  split({ab, b, bc}, plane, depth + 1);
  split({a, ab, bc}, plane, depth + 1);
  split({a, bc, c}, plane, depth + 1);
}

std::uint32_t TriangleFeed::append(const Corner& corner) {
  corners_.push_back(corner);
  written_.push_back(kNotWritten);
  return static_cast<std::uint32_t>(corners_.size() - 1);
}

std::uint32_t TriangleFeed::middle(std::uint32_t a, std::uint32_t b) {
  const auto [low, high] = std::minmax(a, b);
  const auto [known, is_new] = middles_.try_emplace(std::uint64_t{low} << 32U | high, kNotWritten);
  if (is_new) known->second = append(middle_of(corners_[a], corners_[b]));
  return known->second;
}

void TriangleFeed::emit(const Triangle& t, const shared::PrimitivePlane& plane) {
  out_.planes.push_back(plane);
  for (const std::uint32_t i : t) {
    if (written_[i] == kNotWritten) written_[i] = write(corners_[i]);
    out_.indices.push_back(written_[i]);
    const Point3<Physical> p = corners_[i].position;
    item_.low = {std::min(item_.low.x, p.x), std::min(item_.low.y, p.y), std::min(item_.low.z, p.z)};
    item_.high = {std::max(item_.high.x, p.x), std::max(item_.high.y, p.y), std::max(item_.high.z, p.z)};
  }
}

std::uint32_t TriangleFeed::write(const Corner& c) {
  const auto f = [](double value) { return static_cast<float>(value); };
  out_.vertices.push_back({{f(c.position.x), f(c.position.y), f(c.position.z)},
                           {snorm_of(c.normal.x), snorm_of(c.normal.y), snorm_of(c.normal.z), 0},
                           {f(c.uv.x), f(c.uv.y)},
                           {half_of(c.color.r), half_of(c.color.g), half_of(c.color.b), half_of(c.color.a)}});
  return static_cast<std::uint32_t>(out_.vertices.size() - 1);
}

void TriangleFeed::end_item(std::string content) {
  item_.content = std::move(content);
  item_.index_count = static_cast<std::uint32_t>(out_.indices.size()) - item_.first_index;
  if (item_.index_count > 0) out_.items.push_back(item_);
}

}  // namespace lfd
