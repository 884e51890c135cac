// Torn and whole ways between neighbouring pixels.
#include "bench/reference/silhouette.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "bench/reference/parallel_rows.h"

namespace lfd::reference {
namespace {

constexpr double kSteepest_pitches = 2;
constexpr double kLargestBend_pitches = 0.5;
constexpr double kUnexplained_pitches = 0.05;
constexpr double kClosedGap_pitches = 0.01;
constexpr int kMaskSteps = 8;      // to a half of the way between two pixels
constexpr int kMostHalvings = 24;  // then the way is 3e-8 pixels long; a surface still open there is torn

// A pixel position with what its line meets.
struct Sight {
  PixelPoint pixel;
  Hit hit;
};

class Neighbours {
 public:
  Neighbours(const Intersector& intersector, const ModuleView& view) : intersector_(intersector), view_(view) {}

  // Whether a silhouette passes between two neighbouring pixels.
  bool are_torn(PixelPoint p, const std::optional<Hit>& at_p, PixelPoint q, const std::optional<Hit>& at_q) const {
    if (!at_p && !at_q) return false;
    if (!at_p || !at_q) return true;
    const PixelPoint between = halfway(p, q);
    const auto hit = cast_point(intersector_, view_, between);
    if (!hit) return true;
    const Sight middle{between, *hit};
    return !is_whole({p, *at_p}, middle) || !is_whole(middle, {q, *at_q});
  }

 private:
  double whole_depth() const { return view_.display.optics.observer_distance_m; }

  Point3<Physical> at_depth(const PixelLine& line, double depth) const {
    return line.on_screen + (depth / whole_depth()) * (line.on_observer_line - line.on_screen);
  }

  // Of a point on the line.
  double depth_of(const PixelLine& line, Point3<Physical> p) const {
    const Vector3<Physical> along = line.on_observer_line - line.on_screen;
    return whole_depth() * (dot(p - line.on_screen, along) / dot(along, along));
  }

  // Depth at which a line meets the plane of another hit's triangle; not finite where it is parallel.
  double depth_on_plane(const PixelLine& line, const Hit& hit) const {
    const Triangle& t = intersector_.scene().triangle[hit.triangle];
    const auto corner = [&](int i) { return intersector_.scene().corner(t, i).physical; };
    const Vector3<Physical> normal = cross(corner(1) - corner(0), corner(2) - corner(0));
    const Vector3<Physical> along = line.on_observer_line - line.on_screen;
    return dot(normal, hit.physical - line.on_screen) / dot(normal, along) * whole_depth();
  }

  bool planes_explain(const PixelLine& line_p, const Hit& p, const PixelLine& line_q, const Hit& q,
                      double pitch) const {
    const double depth_p = depth_of(line_p, p.physical), depth_q = depth_of(line_q, q.physical);
    const double by_p = depth_on_plane(line_q, p) - depth_p, by_q = depth_q - depth_on_plane(line_p, q);
    const double step = depth_q - depth_p;
    return std::abs(by_p) <= kSteepest_pitches * pitch && std::abs(by_q) <= kSteepest_pitches * pitch &&
           std::abs(by_p - by_q) <= kLargestBend_pitches * pitch &&
           step >= std::min(by_p, by_q) - kUnexplained_pitches * pitch &&
           step <= std::max(by_p, by_q) + kUnexplained_pitches * pitch;
  }

  bool closes(Sight p, Sight q, double pitch) const {
    for (int i = 0; i < kMostHalvings; ++i) {
      if (p.hit.triangle == q.hit.triangle || gap(p, q) <= kClosedGap_pitches * pitch) return true;
      const PixelPoint between = halfway(p.pixel, q.pixel);
      const auto hit = cast_point(intersector_, view_, between);
      if (!hit) return false;
      const Sight middle{between, *hit};
      (gap(p, middle) > gap(middle, q) ? q : p) = middle;
    }
    return false;
  }

  // Whether one triangle is seen all along the way: a mask may have holes that are smaller than it.
  bool is_solid(const Sight& p, const Sight& q) const {
    const WorldScene& scene = intersector_.scene();
    if (!scene.material[scene.triangle[p.hit.triangle].material].alpha_cutoff) return true;
    for (int i = 1; i < kMaskSteps; ++i) {
      const double t = static_cast<double>(i) / kMaskSteps;
      const PixelPoint between{p.pixel.x + t * (q.pixel.x - p.pixel.x), p.pixel.y + t * (q.pixel.y - p.pixel.y)};
      const auto hit = cast_point(intersector_, view_, between);
      if (!hit || hit->triangle != p.hit.triangle) return false;
    }
    return true;
  }

  bool is_whole(const Sight& p, const Sight& q) const {
    if (p.hit.triangle == q.hit.triangle) return is_solid(p, q);
    const auto line_p = pixel_line(view_.display, view_.module, p.pixel);
    const auto line_q = pixel_line(view_.display, view_.module, q.pixel);
    const double pitch = length(at_depth(*line_q, depth_of(*line_p, p.hit.physical)) - p.hit.physical);
    return planes_explain(*line_p, p.hit, *line_q, q.hit, pitch) || closes(p, q, pitch);
  }

  static PixelPoint halfway(PixelPoint p, PixelPoint q) { return {0.5 * (p.x + q.x), 0.5 * (p.y + q.y)}; }

  static double gap(const Sight& p, const Sight& q) { return length(p.hit.physical - q.hit.physical); }

  const Intersector& intersector_;
  const ModuleView& view_;
};

// For each pixel, whether the way to its right and to its lower neighbour is torn.
struct Tears {
  ImageSize size;
  std::vector<std::uint8_t> right, down;

  bool between(PixelIndex p, PixelIndex q) const {
    if (p.column != q.column && p.row != q.row) {
      const PixelIndex by_row{q.column, p.row}, by_column{p.column, q.row};
      return (between(p, by_row) || between(by_row, q)) && (between(p, by_column) || between(by_column, q));
    }
    const std::size_t first =
        static_cast<std::size_t>(std::min(p.row, q.row)) * size.width + std::min(p.column, q.column);
    return (p.row == q.row ? right[first] : down[first]) != 0;
  }
};

Tears find_tears(const Intersector& intersector, const ModuleView& view, const HitImage& image) {
  Tears tears{image.size, std::vector<std::uint8_t>(image.hit.size()), std::vector<std::uint8_t>(image.hit.size())};
  const Neighbours neighbours(intersector, view);
  for_each_row(image.size.height, [&](int row) {
    for (int column = 0; column < image.size.width; ++column) {
      const PixelIndex p{column, row}, right{column + 1, row}, down{column, row + 1};
      const std::size_t i = static_cast<std::size_t>(row) * image.size.width + column;
      if (right.column < image.size.width) {
        tears.right[i] = neighbours.are_torn(centre_of(p), image.at(p), centre_of(right), image.at(right));
      }
      if (down.row < image.size.height) {
        tears.down[i] = neighbours.are_torn(centre_of(p), image.at(p), centre_of(down), image.at(down));
      }
    }
  });
  return tears;
}

}  // namespace

std::vector<std::uint8_t> near_silhouette(const Intersector& intersector, const ModuleView& view,
                                          const HitImage& image) {
  const Tears tears = find_tears(intersector, view, image);
  std::vector<std::uint8_t> near(image.hit.size());
  for_each_row(image.size.height, [&](int row) {
    for (int column = 0; column < image.size.width; ++column) {
      const PixelIndex p{column, row};
      if (!image.at(p)) continue;
      bool torn = false;
      for (int y = std::max(0, row - 1); y <= std::min(image.size.height - 1, row + 1); ++y) {
        for (int x = std::max(0, column - 1); x <= std::min(image.size.width - 1, column + 1); ++x) {
          if (x != column || y != row) torn = torn || tears.between(p, {x, y});
        }
      }
      near[static_cast<std::size_t>(row) * image.size.width + column] = torn;
    }
  });
  return near;
}

}  // namespace lfd::reference
