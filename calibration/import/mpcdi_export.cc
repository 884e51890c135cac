// MPCDI files made of calibrations.
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "base/log.h"
#include "calibration/import/mpcdi.h"
#include "calibration/import/mpcdi_xml.h"
#include "calibration/import/pfm.h"
#include "calibration/import/zip_archive.h"

namespace lfd {
namespace {

// What is worth writing: as far beside the screen as it is large, and on the half of a cylinder that faces the viewer.
bool is_near(const DisplayCalibration& display, ScreenPoint s) {
  const double radius = std::abs(display.optics.screen_radius_m);
  const bool faces = radius == 0 || std::abs(s.x) < 0.5 * std::numbers::pi * radius;
  return faces && contains(ScreenSize{3 * display.screen.width_m, 3 * display.screen.height_m}, s);
}

PfmPixels sample(const DisplayCalibration& display, const ScreenMap& map, ImageSize size, Point3<Physical> origin) {
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  PfmPixels warp{size.width, size.height, {}};
  const double width_px = static_cast<double>(display.image.width) / size.width,
               height_px = static_cast<double>(display.image.height) / size.height;
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const auto s = lit_by(display, map, {(column + 0.5) * width_px, (row + 0.5) * height_px});
      if (!s || !is_near(display, *s)) {
        warp.numbers.insert(warp.numbers.end(), {kNothing, kNothing, kNothing});
        continue;
      }
      const Point3<Physical> p = surface_point(display.optics, *s);
      warp.numbers.insert(warp.numbers.end(), {static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y),
                                               static_cast<float>(p.z - origin.z)});
    }
  }
  return warp;
}

Status check_size(const DisplayCalibration& display, ImageSize size) {
  for (const auto& [name, side] : {std::pair{"width", size.width}, std::pair{"height", size.height}}) {
    if (side < 2 || side > kMaxGridSide) {
      return Error(fmt::format("warps: {}: {} px; 2 to {} are possible", name, side, kMaxGridSide));
    }
  }
  const double bytes = 12.0 * size.width * size.height * static_cast<double>(display.modules.size());
  if (bytes > static_cast<double>(kMpcdiTotalLimit_bytes)) {
    return Error(fmt::format("warps: {} of {} x {} px are {:.2g} bytes; at most {} are written: choose a smaller size",
                             display.modules.size(), size.width, size.height, bytes, kMpcdiTotalLimit_bytes));
  }
  return {};
}

}  // namespace

Result<std::string> export_mpcdi(const DisplayCalibration& display, std::optional<ImageSize> size) {
  const ImageSize pixels = size.value_or(display.image);
  LFD_TRY_STATUS(check_size(display, pixels));
  const Point3<Physical> origin = centre_of_mass(display.screen, display.optics);
  MpcdiDocument document{"a3", "2.0", {}, {}};
  document.extension = MpcdiExtension{display.name, display.screen, display.optics, display.angular_scattering_rad};
  std::vector<ZipEntry> entries(1);
  for (std::size_t k = 0; k < display.modules.size(); ++k) {
    const ModuleCalibration& module = display.modules[k];
    MpcdiRegion region;
    region.id = fmt::format("module-{:03}", k);
    region.resolution = display.image;
    region.position =
        Point3<Physical>{module.emitter.x - origin.x, module.emitter.y - origin.y, module.emitter.z - origin.z};
    region.warp_path = region.id + ".pfm";
    region.warp_unit = std::string("m");
    region.warp_origin = std::string("centerOfMass");
    region.warp_interpolation = std::string("linear");
    entries.push_back({region.warp_path, print_pfm(sample(display, module.map, pixels, origin))});
    document.regions.push_back(std::move(region));
  }
  entries.front() = {"mpcdi.xml", print_mpcdi_xml(document)};
  return write_zip(entries);
}

}  // namespace lfd
