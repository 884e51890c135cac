// Calibrations made of MPCDI files.
#include "calibration/import/mpcdi.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "base/log.h"
#include "calibration/curved_screen.h"
#include "calibration/import/foreign_fields.h"
#include "calibration/import/mpcdi_xml.h"
#include "calibration/import/pfm.h"
#include "calibration/import/zip_archive.h"

namespace lfd {
namespace {

constexpr const char* kXmlEntry = "mpcdi.xml";
constexpr std::size_t kWarpLimit_bytes = std::size_t{12} * kMaxGridSide * kMaxGridSide + 256;  // with its header
constexpr double kHole = std::numeric_limits<double>::quiet_NaN();

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Result<double> metres_of(const std::string& unit) {
  static const std::map<std::string, double> kUnits{{"mm", 1e-3},   {"cm", 1e-2},   {"dm", 0.1},   {"m", 1},
                                                    {"in", 0.0254}, {"ft", 0.3048}, {"yd", 0.9144}};
  const auto found = kUnits.find(lower_case(unit));
  if (found == kUnits.end()) {
    return Error(fmt::format("geometricUnit: \"{}\"; mm, cm, dm, m, in, ft or yd is needed", unit));
  }
  return found->second;
}

Result<Point3<Physical>> origin_of(const std::string& name, const DisplayCalibration& display) {
  const std::string origin = lower_case(name);
  if (origin == "centerofmass") return centre_of_mass(display.screen, display.optics);
  if (origin == "idealeyepoint") {
    return Point3<Physical>{0, display.optics.observer_height_m, display.optics.observer_distance_m};
  }
  return Error(fmt::format(
      "originOf3DData: \"{}\"; where that is must be told (centerOfMass and idealEyePoint are known)", name));
}

// An error of the emitter that coordinateFrame's position has made.
Error error_of_position(const Error& error) {
  constexpr std::string_view kRoad = "emitter: ";
  return Error("coordinateFrame: pos" + error.message().substr(kRoad.size()));
}

// Errors of validate() about what the extension says.
Error error_of_extension(const Error& error, int line) {
  const Error said = in_foreign_words(error, {{"screen: width_m", line, "screenWidth"},
                                              {"screen: height_m", line, "screenHeight"},
                                              {"optics: screen_radius_m", line, "screenRadius"},
                                              {"optics: observer_height_m", line, "observerHeight"},
                                              {"optics: observer_distance_m", line, "observerDistance"},
                                              {"optics: observer_arc", line, "observerArc"},
                                              {"optics: diffuser", line, "diffuser"},
                                              {"angular_scattering_rad", line, "angularScattering"}});
  return Error(fmt::format("{}:{}", kXmlEntry, said.message()));
}

// A point near the screen's surface: where on it, and how far from it.
struct OnSurface {
  ScreenPoint at;
  double distance_m = 0;
};

OnSurface onto_surface(const Optics& optics, const Point3<Physical>& p) {
  if (optics.screen_radius_m == 0) return {{p.x, p.y}, std::abs(p.z)};
  const CurvedScreen screen(optics.screen_radius_m);
  const auto s = screen.arc_length_of({p.x, p.z});
  if (!s) return {{kHole, kHole}, std::numeric_limits<double>::infinity()};
  const glm::dvec2 nearest = screen.point_at(*s);
  return {{*s, p.y}, std::hypot(p.x - nearest.x, p.z - nearest.y)};
}

// The warp's pixels as points of the screen, row by row.
Result<std::vector<ScreenPoint>> screen_points(const PfmPixels& warp, double metre, const Point3<Physical>& origin,
                                               const Optics& optics, double tolerance_m) {
  std::vector<ScreenPoint> points;
  points.reserve(warp.numbers.size() / 3);
  double farthest_m = 0;
  PixelIndex where;
  for (int row = 0; row < warp.height; ++row) {
    for (int column = 0; column < warp.width; ++column) {
      const float* const p = warp.at(column, row);
      if (std::isnan(p[0]) || std::isnan(p[1]) || std::isnan(p[2])) {
        points.push_back({kHole, kHole});
        continue;
      }
      const OnSurface on =
          onto_surface(optics, {origin.x + metre * p[0], origin.y + metre * p[1], origin.z + metre * p[2]});
      points.push_back(on.at);
      // An infinite coordinate is infinitely far away.
      const double distance_m = std::isnan(on.distance_m) ? std::numeric_limits<double>::infinity() : on.distance_m;
      if (distance_m > farthest_m) {
        farthest_m = distance_m;
        where = {column, row};
      }
    }
  }
  if (farthest_m <= tolerance_m) return points;
  const float* const p = warp.at(where.column, where.row);
  return Error(
      fmt::format("pixel ({}, {}): ({}, {}, {}) is {:.6g} m off the screen's surface; at most {:g} m is possible",
                  where.column, where.row, p[0], p[1], p[2], farthest_m, tolerance_m));
}

// Paths in the archive: '/' parts them, and none may lead out of it.
Result<std::string> entry_of(const std::string& path) {
  if (path.empty()) return Error("geometryWarpFile: path: is missing");
  std::string entry = path;
  std::ranges::replace(entry, '\\', '/');
  while (entry.starts_with("./")) entry.erase(0, 2);
  if (entry.starts_with('/') || ("/" + entry + "/").find("/../") != entry.npos) {
    return Error(fmt::format("geometryWarpFile: path: \"{}\" leaves the archive", path));
  }
  return entry;
}

class Importer {
 public:
  Importer(ZipReader& zip, const MpcdiDocument& document, const MpcdiImportOptions& options)
      : zip_(zip), document_(document), options_(options) {}

  Result<MpcdiImport> run();

 private:
  Status start();
  Result<ModuleCalibration> module_of(const MpcdiRegion& region, std::size_t k);
  Result<GridMap> map_of(const MpcdiRegion& region, double metre, const Point3<Physical>& origin);

  ZipReader& zip_;
  const MpcdiDocument& document_;
  const MpcdiImportOptions& options_;
  MpcdiImport import_;
  std::map<std::string, int> left_out_;  // how often each
  bool is_thinned_ = false;
  ThinningLoss thinning_;  // the worst of all regions
};

// Everything but the modules.
Status Importer::start() {
  if (lower_case(document_.profile) != "a3") {
    return Error(fmt::format("MPCDI: profile: \"{}\"; only a3 has points of the screen", document_.profile));
  }
  if (!document_.version.starts_with("1.") && !document_.version.starts_with("2.")) {
    return Error(fmt::format("MPCDI: version: \"{}\"; 1.0 and 2.0 are known", document_.version));
  }
  if (document_.regions.empty()) return Error("display: no regions");
  DisplayCalibration& display = import_.display;
  if (options_.like != nullptr) {
    display = *options_.like;
    display.modules.clear();
  } else if (document_.extension) {
    const MpcdiExtension& extension = *document_.extension;
    display = {extension.name, extension.screen, {}, extension.optics, extension.angular_scattering_rad, {}};
  } else {
    return Error(
        "nothing says the size of the screen, its diffuser and the observer line; a display like it must be "
        "given");
  }
  display.image = document_.regions.front().resolution;
  if (options_.like == nullptr) {
    const Status status = validate_without_modules(display);
    return status ? status : error_of_extension(status.error(), document_.extension->line);
  }
  if (options_.like->modules.size() != document_.regions.size()) {
    return Error(fmt::format("{} regions, but the display given has {} modules", document_.regions.size(),
                             options_.like->modules.size()));
  }
  if (options_.like->image != display.image) {
    return Error(fmt::format("regions of {} x {} px, but the display given has images of {} x {} px",
                             display.image.width, display.image.height, options_.like->image.width,
                             options_.like->image.height));
  }
  return {};
}

Result<GridMap> Importer::map_of(const MpcdiRegion& region, double metre, const Point3<Physical>& origin) {
  const std::string interpolation = lower_case(region.warp_interpolation);
  if (!interpolation.empty() && interpolation != "linear" && interpolation != "smooth") {
    return Error(fmt::format("interpolation: \"{}\"; linear or smooth is needed", region.warp_interpolation));
  }
  LFD_TRY(const std::string entry, entry_of(region.warp_path));
  LFD_TRY(const std::string content, zip_.read(entry, kWarpLimit_bytes));
  const auto warp = parse_pfm(content, kMaxGridSide);
  if (!warp) return warp.error().within(entry);
  auto points = screen_points(*warp, metre, origin, import_.display.optics, options_.tolerance_m);
  if (!points) return points.error().within(entry);
  const auto thin = thinned({warp->width, warp->height, region.resolution, *std::move(points)}, options_.thinning);
  if (!thin) return thin.error().within(entry);
  const GridNodes& nodes = thin->map.nodes();
  if (nodes.columns < warp->width || nodes.rows < warp->height) {
    ++left_out_[fmt::format("warps of {} x {} points were thinned to {} x {}", warp->width, warp->height, nodes.columns,
                            nodes.rows)];
    thinning_.median_px = std::max(thinning_.median_px, thin->loss.median_px);
    thinning_.max_px = std::max(thinning_.max_px, thin->loss.max_px);
    thinning_.holes_changed = std::max(thinning_.holes_changed, thin->loss.holes_changed);
    is_thinned_ = true;
  }
  return thin->map;
}

Result<ModuleCalibration> Importer::module_of(const MpcdiRegion& region, std::size_t k) {
  if (region.resolution != import_.display.image) {
    return Error(fmt::format("{} x {} px, but the first region has {} x {} px", region.resolution.width,
                             region.resolution.height, import_.display.image.width, import_.display.image.height));
  }
  LFD_TRY(const double metre, metres_of(region.warp_unit));
  Point3<Physical> origin;
  if (options_.origin) {
    origin = *options_.origin;
  } else {
    LFD_TRY(origin, origin_of(region.warp_origin, import_.display));
  }
  for (const std::string& map : region.other_maps) ++left_out_[map + " is not imported"];
  Emitter emitter;
  if (options_.like != nullptr) {
    emitter = options_.like->modules[k].emitter;
  } else if (region.position) {
    const Point3<Physical>& p = *region.position;
    emitter = {origin.x + metre * p.x, origin.y + metre * p.y, origin.z + metre * p.z};
    if (const Status status = validate(emitter); !status) return error_of_position(status.error());
  } else {
    return Error("coordinateFrame: is missing, and no display like it is given: nothing says where the emitter is");
  }
  LFD_TRY(GridMap map, map_of(region, metre, origin));
  ModuleCalibration module{emitter, std::move(map)};
  if (options_.like != nullptr) module.color = options_.like->modules[k].color;
  return module;
}

Result<MpcdiImport> Importer::run() {
  LFD_TRY_STATUS(start());
  for (std::size_t k = 0; k < document_.regions.size(); ++k) {
    const MpcdiRegion& region = document_.regions[k];
    auto module = module_of(region, k);
    if (!module) return module.error().within(fmt::format("{}:{}: region {}", kXmlEntry, region.line, region.id));
    import_.display.modules.push_back(*std::move(module));
  }
  LFD_TRY_STATUS(validate(import_.display));
  for (const auto& [what, count] : left_out_) {
    import_.warnings.push_back(fmt::format("{} (in {} of {} regions)", what, count, document_.regions.size()));
  }
  if (is_thinned_) {
    import_.warnings.push_back(fmt::format(
        "thinning moved points by up to {:.2g} px (median {:.2g} px) and changed {:.2g} % of the pixels to or "
        "from holes, in the worst of the regions; {:g} px is aimed at",
        thinning_.max_px, thinning_.median_px, 100 * thinning_.holes_changed, options_.thinning.tolerance_px));
  }
  return std::move(import_);
}

Result<MpcdiImport> import_archive(std::string_view archive, const MpcdiImportOptions& options) {
  LFD_TRY(ZipReader zip, ZipReader::open(archive, kMpcdiTotalLimit_bytes));
  LFD_TRY(const std::string xml, zip.read(kXmlEntry, kMpcdiXmlLimit_bytes));
  const auto document = parse_mpcdi_xml(xml);
  if (!document) return Error(fmt::format("{}:{}", kXmlEntry, document.error().message()));
  return Importer(zip, *document, options).run();
}

}  // namespace

Point3<Physical> centre_of_mass(ScreenSize screen, const Optics& optics) {
  const double radius = optics.screen_radius_m;
  if (radius == 0) return {};
  const double half_angle = 0.5 * screen.width_m / radius;
  return {0, 0, radius * (std::sin(half_angle) / half_angle - 1)};
}

Result<MpcdiImport> import_mpcdi(std::string_view archive, const std::string& file, const MpcdiImportOptions& options) {
  LFD_CHECK(options.thinning.most_nodes >= 2, "a grid map needs two nodes a side");
  auto import = import_archive(archive, options);
  if (!import) return import.error().within(file);
  return import;
}

}  // namespace lfd
