// Surface points that two modules show: planes whose places in both pictures are known.
#include "bench/ao/consistency.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "calibration/make.h"

namespace lfd::bench {
namespace {

constexpr double kBehind = -0.1;  // metres behind the screen: neighbours show it shifted

// A module's picture of the plane at a physical z that may depend on the pixel.
ShownSurfaces plane_in(const DisplayCalibration& display, std::size_t module,
                       const std::function<double(PixelIndex)>& z_at) {
  ShownSurfaces shown{&display.modules[module],
                      {display.image.width, display.image.height, {}},
                      {display.image.width, display.image.height, {}}};
  for (int row = 0; row < display.image.height; ++row) {
    for (int column = 0; column < display.image.width; ++column) {
      const auto line = pixel_line(display, display.modules[module], centre_of({column, row}));
      LFD_CHECK(line, "every pixel of a made display has one");
      const Vector3<Physical> along = line->on_observer_line - line->on_screen;
      const Point3<Physical> p = line->on_screen + (z_at({column, row}) / along.z) * along;
      for (const double part : {p.x, p.y, p.z, 1.0}) shown.position.rgba.push_back(static_cast<float>(part));
      for (const float part : {0.0F, 0.0F, 1.0F, 1.0F}) shown.normal.rgba.push_back(part);
    }
  }
  return shown;
}

// Openness that depends on the place on the plane alone.
Openness painted(const ShownSurfaces& shown, const std::function<double(double, double)>& value) {
  Openness open{{shown.position.width, shown.position.height}, {}};
  for (std::size_t i = 0; i < shown.position.rgba.size(); i += 4)
    open.value.push_back(static_cast<float>(value(shown.position.rgba[i], shown.position.rgba[i + 1])));
  return open;
}

class AoConsistency : public testing::Test {
 protected:
  const DisplayCalibration display_ = *make_display("desk");
  const std::function<double(PixelIndex)> flat_ = [](PixelIndex) { return kBehind; };
  const ShownSurfaces one_ = plane_in(display_, 3, flat_), other_ = plane_in(display_, 4, flat_);
};

TEST_F(AoConsistency, FindsTheSamePlaceInTheOtherPicture) {
  const auto points = shared_points(display_, one_, other_, {});
  const auto all = static_cast<double>(display_.image.width * display_.image.height);
  EXPECT_GT(static_cast<double>(points.size()), 0.8 * all) << "all but what lies beside the other's picture";
  // A value that grows with the place shows where a match went wrong: by how many metres.
  const Openness mine = painted(one_, [](double x, double) { return x; }),
                 theirs = painted(other_, [](double x, double) { return x; });
  double worst = 0, mean_shift_px = 0;
  for (const SharedPoint& point : points) {
    double there = 0;
    for (std::size_t k = 0; k < 4; ++k) there += point.weight[k] * theirs.value[point.other[k]];
    worst = std::max(worst, std::abs(there - mine.value[point.pixel]));
    mean_shift_px +=
        (static_cast<double>(point.other[0] % 256) - point.pixel % 256) / static_cast<double>(points.size());
  }
  const double pixel_m = display_.screen.width_m / display_.image.width;
  EXPECT_LT(worst, 0.6 * pixel_m) << "bilinear places are exact inside; at the border a corner may be missing";
  EXPECT_GT(std::abs(mean_shift_px), 1) << "the plane lies behind the screen: the pictures are shifted";
}

TEST_F(AoConsistency, CountsDifferencesBeyondItsBound) {
  const auto points = shared_points(display_, one_, other_, {});
  const auto smooth = [](double x, double y) { return 0.5 + 0.2 * std::sin(10 * x) * std::cos(10 * y); };
  EXPECT_EQ(inconsistent_share(points, painted(one_, smooth), painted(other_, smooth)), 0);
  const auto off_by = [&](double difference) {
    return inconsistent_share(points, painted(one_, smooth),
                              painted(other_, [&](double x, double y) { return smooth(x, y) + difference; }));
  };
  EXPECT_EQ(off_by(0.015), 0);
  EXPECT_EQ(off_by(0.025), 1);
  EXPECT_EQ(off_by(-0.025), 1);
  const auto half = [&](double x, double y) { return smooth(x, y) + (x < 0 ? 0.1 : 0); };
  EXPECT_NEAR(inconsistent_share(points, painted(one_, smooth), painted(other_, half)), 0.5, 0.05);
  // What one of them does not find is no difference.
  Openness holes = painted(other_, smooth);
  for (std::size_t i = 0; i < holes.value.size(); i += 3) holes.value[i] = -1;
  EXPECT_EQ(inconsistent_share(points, painted(one_, smooth), holes), 0);
  EXPECT_EQ(inconsistent_share({}, painted(one_, smooth), painted(other_, smooth)), 0);
}

TEST_F(AoConsistency, AnotherSurfaceIsNoneOfTheSame) {
  const ShownSurfaces nearer = plane_in(display_, 4, [](PixelIndex) { return 0.05; });
  EXPECT_TRUE(shared_points(display_, one_, nearer, {}).empty());
  ShownSurfaces turned = other_;
  for (std::size_t i = 0; i < turned.normal.rgba.size(); i += 4) turned.normal.rgba[i + 2] = -1;
  EXPECT_TRUE(shared_points(display_, one_, turned, {}).empty()) << "its back is not its front";
  ShownSurfaces nothing = other_;
  for (std::size_t i = 3; i < nothing.position.rgba.size(); i += 4) nothing.position.rgba[i] = 0;
  EXPECT_TRUE(shared_points(display_, one_, nothing, {}).empty());
}

}  // namespace
}  // namespace lfd::bench
