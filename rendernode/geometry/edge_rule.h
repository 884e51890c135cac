// Which edges must be split, so that what is drawn straight is nowhere far from where the map would put it.
//
// A rasteriser draws the points between two corners on the straight line between their clip points; the map is not
// projective, so they belong elsewhere. The rule looks at one edge at a time and at nothing else: triangles that share
// it decide alike, and no crack opens (design geometry, section 4).
#pragma once

#include <vector>

#include "rendernode/geometry/clip_map.h"
#include "rendernode/geometry/depth_limits.h"

namespace lfd {

class EdgeRule {
 public:
  // tolerance_px: how far the drawn edge may lie beside the true one; along the edge (which moves textures and depth,
  // not outlines) twenty times as much is allowed. modules: those the geometry is drawn for.
  // tables: those of the modules, which outlive the rule.
  EdgeRule(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules, const WarpTables& tables,
           const DepthLimits& limits, double tolerance_px);

  // Symmetric in its arguments.
  bool must_split(Point3<Physical> a, Point3<Physical> b) const;

  // How far beside an edge, on the screen, a triangle that need not be split may still find pixels, metres: by the
  // tolerance, and by the grid that rasterisers bring corners to.
  double beside_m() const;

  // Largest deviation over all modules that see the edge, in tolerances (tests: at most 1 where must_split says no).
  double deviation(Point3<Physical> a, Point3<Physical> b) const;

 private:
  bool is_beside(const ClipMap& map, Point3<Physical> a, Point3<Physical> b) const;
  struct Deviation {
    double tolerances = 0;
    bool is_beside_image = false;  // it is not seen, however it is drawn
  };
  Deviation deviation_in(const ClipMap& map, Point3<Physical> a, Point3<Physical> b) const;
  double seen_deviation(const ClipMap& map, Point3<Physical> a, Point3<Physical> b) const;  // 0 where it is not seen
  double bend_between(double z0, double z1) const;
  void lay_slices();
  void measure_bend();
  double steepest_bend_at(double z) const;

  const DisplayCalibration* display_;
  std::vector<ClipMap> maps_;
  std::vector<Emitter> emitters_;
  DepthLimits limits_;
  double tolerance_px_;
  // Slices of z, finer toward the observers and toward the singularity, where the map is steep: borders, ascending.
  std::vector<double> border_;
  // Per slice: no edge of length L in it deviates by more than bend * L^2 tolerances. Measured over the screen
  // with a margin, it only spares most short edges the exact test.
  std::vector<double> bend_;
};

}  // namespace lfd
