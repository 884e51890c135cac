// mpcdi.xml written, through pugixml.
#include <pugixml.hpp>

#include <sstream>

#include "base/log.h"
#include "calibration/import/mpcdi_xml.h"

namespace lfd {
namespace {

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name) = value.c_str();
}

// The shortest text that reads as this number again.
void set(pugi::xml_node node, const char* name, double value) { set(node, name, fmt::format("{}", value)); }

void add_text(pugi::xml_node node, const char* name, const std::string& text) {
  node.append_child(name).text() = text.c_str();
}

// Axes of an aeroplane that flies away from the audience: with x right, y up, z toward the viewer, its pitch axis is x,
// its yaw axis -y, its roll axis -z.
void add_frame(pugi::xml_node region, const Point3<Physical>& position) {
  pugi::xml_node frame = region.append_child("coordinateFrame");
  for (const auto& [name, value] :
       {std::pair{"posx", position.x}, std::pair{"posy", position.y}, std::pair{"posz", position.z},
        std::pair{"yawx", 0.0}, std::pair{"yawy", -1.0}, std::pair{"yawz", 0.0}, std::pair{"pitchx", 1.0},
        std::pair{"pitchy", 0.0}, std::pair{"pitchz", 0.0}, std::pair{"rollx", 0.0}, std::pair{"rolly", 0.0},
        std::pair{"rollz", -1.0}}) {
    add_text(frame, name, fmt::format("{}", value));
  }
}

void add_region(pugi::xml_node buffer, const MpcdiRegion& region) {
  pugi::xml_node node = buffer.append_child("region");
  set(node, "id", region.id);
  set(node, "xResolution", region.resolution.width);
  set(node, "yResolution", region.resolution.height);
  for (const auto& [name, value] :
       {std::pair{"x", 0}, std::pair{"y", 0}, std::pair{"xsize", 1}, std::pair{"ysize", 1}}) {
    set(node, name, value);
  }
  if (region.position) add_frame(node, *region.position);
}

void add_fileset(pugi::xml_node files, const MpcdiRegion& region) {
  pugi::xml_node set_node = files.append_child("fileset");
  set(set_node, "region", region.id);
  pugi::xml_node warp = set_node.append_child("geometryWarpFile");
  add_text(warp, "path", region.warp_path);
  add_text(warp, "interpolation", region.warp_interpolation);
  add_text(warp, "geometricUnit", region.warp_unit);
  add_text(warp, "originOf3DData", region.warp_origin);
}

void add_extension(pugi::xml_node root, const MpcdiExtension& extension) {
  pugi::xml_node holder = root.append_child("extensionSet").append_child("extension");
  set(holder, "Name", std::string("LightFieldDisplay"));
  set(holder, "hasExternalFiles", std::string("false"));
  pugi::xml_node node = holder.append_child("lightFieldDisplay");
  const Optics& optics = extension.optics;
  set(node, "name", extension.name);
  set(node, "screenWidth", extension.screen.width_m);
  set(node, "screenHeight", extension.screen.height_m);
  set(node, "screenRadius", optics.screen_radius_m);
  set(node, "diffuser", std::string(optics.diffuser == Diffuser::kLinear ? "linear" : "conical"));
  set(node, "observerHeight", optics.observer_height_m);
  set(node, "observerDistance", optics.observer_distance_m);
  set(node, "observerArc", std::string(optics.observer_arc ? "true" : "false"));
  set(node, "angularScattering", extension.angular_scattering_rad);
}

}  // namespace

std::string print_mpcdi_xml(const MpcdiDocument& document) {
  pugi::xml_document xml;
  pugi::xml_node declaration = xml.append_child(pugi::node_declaration);
  set(declaration, "version", std::string("1.0"));
  set(declaration, "encoding", std::string("utf-8"));
  pugi::xml_node root = xml.append_child("MPCDI");
  set(root, "profile", document.profile);
  set(root, "geometry", 1);
  set(root, "color", 1);
  set(root, "date", std::string("1980-01-01 00:00:00"));  // required; equal displays give equal files
  set(root, "version", document.version);
  pugi::xml_node buffer = root.append_child("display").append_child("buffer");
  set(buffer, "id", std::string("display"));
  if (!document.regions.empty()) {
    set(buffer, "xResolution", document.regions.front().resolution.width);
    set(buffer, "yResolution", document.regions.front().resolution.height);
  }
  pugi::xml_node files = root.append_child("files");
  for (const MpcdiRegion& region : document.regions) {
    add_region(buffer, region);
    add_fileset(files, region);
  }
  if (document.extension) add_extension(root, *document.extension);
  std::ostringstream text;
  xml.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
  return text.str();
}

}  // namespace lfd
