// Rays from one eye through the screen.
#include "bench/reference/perspective.h"

#include <algorithm>
#include <cmath>

#include "bench/reference/parallel_rows.h"

namespace lfd::reference {
namespace {

// Where the rays may end: the far limit, or just behind everything.
double farthest_z(const WorldScene& scene, const ZLimits& limits) {
  if (std::isfinite(limits.far_z_m)) return limits.far_z_m;
  double z = 0;
  for (const Vertex& v : scene.vertex) z = std::min(z, v.physical.z);
  return 1.001 * z - 0.001;
}

glm::dvec3 color_through(const Intersector& intersector, Point3<Physical> eye, Point3<Physical> on_screen,
                         double z_start, double z_end, glm::dvec3 background) {
  const Vector3<Physical> along = on_screen - eye;  // at_z: eye.z > 0 = on_screen.z
  const auto at_z = [&](double z) { return eye + ((z - eye.z) / along.z) * along; };
  const auto hit = intersector.first_hit(at_z(z_start), at_z(z_end));
  if (!hit) return background;
  return intersector.scene().base_color(intersector.scene().triangle[hit->triangle], hit->barycentric);
}

std::uint8_t encoded(double linear) {
  return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(std::clamp(linear, 0.0, 1.0))));
}

}  // namespace

PerspectivePicture perspective(const Intersector& intersector, ScreenSize screen, Point3<Physical> eye,
                               const PerspectiveSettings& settings) {
  LFD_CHECK(eye.z > 0, "the eye is before the screen");
  LFD_CHECK(settings.samples_per_side > 0, "at least one sample a pixel");
  const ImageSize size = settings.size;
  const int n = settings.samples_per_side;
  const double z_start = std::min(eye.z, settings.limits.near_z_m);
  const double z_end = farthest_z(intersector.scene(), settings.limits);
  const std::size_t numbers = std::size_t{4} * size.width * size.height;
  PerspectivePicture picture{{size.width, size.height, std::vector<float>(numbers)},
                             black_picture(size.width, size.height)};
  for_each_row(size.height, [&](int row) {
    for (int column = 0; column < size.width; ++column) {
      glm::dvec3 sum(0);
      for (int i = 0; i < n * n; ++i) {
        const PixelPoint p{column + (i % n + 0.5) / n, row + (i / n + 0.5) / n};
        const ScreenPoint s = screen_from_image(IdealMap{}, screen, size, p);
        sum += color_through(intersector, eye, {s.x, s.y, 0}, z_start, z_end, settings.background);
      }
      const glm::dvec3 color = sum / static_cast<double>(n * n);
      const std::size_t first = 4 * (static_cast<std::size_t>(row) * size.width + column);
      for (int channel = 0; channel < 3; ++channel) {
        picture.linear.rgba[first + channel] = static_cast<float>(color[channel]);
        picture.encoded.rgba[first + channel] = encoded(color[channel]);
      }
      picture.linear.rgba[first + 3] = 1;
      picture.encoded.rgba[first + 3] = 255;
    }
  });
  return picture;
}

}  // namespace lfd::reference
