// Lines of pixels, from the observer line into the scene.
#include "bench/reference/caster.h"

#include <algorithm>

#include "bench/reference/parallel_rows.h"

namespace lfd::reference {

std::optional<VisibleWay> visible_way(const ModuleView& view, const PixelLine& line) {
  const Optics& optics = view.display.optics;
  const double vz = optics.observer_distance_m;
  const double nearest = std::min(vz, view.limits.near_z_m),
               farthest = std::max(line.singular_depth, view.limits.far_z_m);
  if (!(farthest < nearest)) return std::nullopt;
  const Vector3<Physical> along = line.on_observer_line - line.on_screen;
  return VisibleWay{line.on_screen + (nearest / vz) * along, line.on_screen + (farthest / vz) * along, nearest,
                    farthest};
}

std::optional<Hit> cast_point(const Intersector& intersector, const ModuleView& view, PixelPoint p) {
  const auto line = pixel_line(view.display, view.module, p);
  if (!line) return std::nullopt;
  const auto way = visible_way(view, *line);
  if (!way) return std::nullopt;
  return intersector.first_hit(way->nearest, way->farthest);
}

HitImage cast_module(const Intersector& intersector, const ModuleView& view) {
  HitImage image{view.display.image, {}};
  image.hit.resize(static_cast<std::size_t>(image.size.width) * image.size.height);
  for_each_row(image.size.height, [&](int row) {
    for (int column = 0; column < image.size.width; ++column) {
      image.hit[static_cast<std::size_t>(row) * image.size.width + column] =
          cast_point(intersector, view, centre_of({column, row}));
    }
  });
  return image;
}

}  // namespace lfd::reference
