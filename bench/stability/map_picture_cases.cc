// Pictures through measured grids with folds and holes, and through lenses that turn back.
#include <cmath>
#include <limits>

#include "base/log.h"
#include "bench/stability/bent_grids.h"
#include "bench/stability/drawing.h"
#include "bench/stability/groups.h"
#include "calibration/check/acceptance.h"
#include "calibration/make.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "pictures through maps";
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// 128 x 96 pixels.
GridNodes bent_nodes() { return bench::bent_nodes({128, 96}); }

Drawing through(const ScreenMap& map) {
  DisplayCalibration display = small_display();
  display.modules[0].map = map;
  return {display, sphere_in_box(small_roi()), small_roi(), {}};
}

Drawing through_grid(const GridNodes& nodes) {
  const auto map = GridMap::make(nodes);
  LFD_CHECK(map, map.error().message());
  return through(*map);
}

GridNodes with_node(ScreenPoint value) { return bench::with_node(bent_nodes(), value); }

// What the controller refuses before anything is rendered, unless it is told to show it all the same.
StabilityCase not_accepted(const std::string& name, const std::string& words, std::function<Drawing()> make) {
  return refused(kGroup, name + ": before anything is rendered", words,
                 [make = std::move(make)] { return accept_calibration(make().display); });
}

// 128 x 96 pixels from 0.6 m behind the screen; the corners are 0.42 from the axis.
PinholeMap lens(double k1, double p1 = 0, double p2 = 0, double k2 = 0, double k3 = 0) {
  const DisplayCalibration display = small_display();
  PinholeMap map = pinhole_of_ideal(display.screen, display.image, {0, 0, -0.6});
  map.k1 = k1;
  map.p1 = p1;
  map.p2 = p2;
  map.k2 = k2;
  map.k3 = k3;
  return map;
}

void add_grids(StabilityCases& cases) {
  cases.push_back(drawn_true(kGroup, "grid bent smoothly", [] { return through_grid(bent_nodes()); }));
  cases.push_back(drawn_true(kGroup, "grid mirrored as a whole", [] { return through_grid(mirrored(bent_nodes())); }));
  cases.push_back(drawn_true(kGroup, "grid with holes along two borders",
                             [] { return through_grid(with_holes_at_border(bent_nodes())); }));
  cases.push_back(drawn_true(kGroup, "grid with a hole in the middle", [] {
    return through_grid(with_node({kNaN, kNaN}));
  }));
  // A node that is off by three of its neighbours' distances.
  cases.push_back(drawn_true(kGroup, "grid with one node a little off", [] {
    return through_grid(with_node({0.004, 0.003}));
  }));
  const std::pair<const char*, GridNodes> no_maps[] = {
      {"grid folded twice", folded(bent_nodes())},
      {"grid with one node thrown far across its neighbours", with_node({0.19, -0.14})},
      {"grid with one node at 9999 m", with_node({9999, 0})}};
  for (const auto& [name, nodes] : no_maps) {
    cases.push_back(not_accepted(name, "folded", [nodes = nodes] { return through_grid(nodes); }));
  }
  // What is shown all the same, because the controller was told to.
  cases.push_back(
      drawn_finite(kGroup, "grid folded twice: shown all the same", [] { return through_grid(folded(bent_nodes())); }));
  cases.push_back(drawing_refused(kGroup, "grid with one node thrown far across its neighbours: shown all the same",
                                  "the grid bends too sharply", [] {
                                    return through_grid(with_node({0.19, -0.14}));
                                  }));
}

void add_lenses(StabilityCases& cases) {
  cases.push_back(drawn_true(kGroup, "lens without distortion", [] { return through(lens(0)); }));
  cases.push_back(drawn_true(kGroup, "lens with k1 = -0.5", [] { return through(lens(-0.5)); }));
  cases.push_back(
      drawn_true(kGroup, "lens with k1 = -2.2: turns back in the corners", [] { return through(lens(-2.2)); }));
  cases.push_back(drawn_true(kGroup, "lens with k1 = -10: turns back in mid-image", [] { return through(lens(-10)); }));
  cases.push_back(drawn_true(kGroup, "lens with k1 = 3", [] { return through(lens(3)); }));
  cases.push_back(drawn_true(kGroup, "lens with k1 = 1e6", [] { return through(lens(1e6)); }));
  cases.push_back(drawn_true(kGroup, "lens with p1 = 0.02, p2 = -0.01", [] { return through(lens(0, 0.02, -0.01)); }));
  cases.push_back(drawn_true(kGroup, "lens with k1 = -6, k2 = 25: turns back and forth",
                             [] { return through(lens(-6, 0, 0, 25)); }));
  cases.push_back(drawn_true(kGroup, "lens with k1 = -4, k2 = 7.21: almost turns back",
                             [] { return through(lens(-4, 0, 0, 7.21)); }));
  cases.push_back(
      drawn_true(kGroup, "lens with k3 = -200: turns back", [] { return through(lens(0, 0, 0, 0, -200)); }));
  cases.push_back(drawn_true(kGroup, "lens with p1 = 0.8, p2 = -0.6: turns back sideways",
                             [] { return through(lens(0, 0.8, -0.6)); }));
}

}  // namespace

void add_map_picture_cases(StabilityCases& cases) {
  add_grids(cases);
  add_lenses(cases);
}

}  // namespace lfd::bench
