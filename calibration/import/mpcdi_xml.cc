// mpcdi.xml through pugixml.
#include "calibration/import/mpcdi_xml.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <pugixml.hpp>

#include "base/log.h"

namespace lfd {
namespace {

constexpr const char* kExtension = "lightFieldDisplay";

bool same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::ranges::equal(a, b, {}, lower, lower);
}

pugi::xml_node child(const pugi::xml_node& node, const char* name) {
  return node.find_child([name](const pugi::xml_node& one) { return same_name(one.name(), name); });
}

pugi::xml_attribute attribute(const pugi::xml_node& node, const char* name) {
  return node.find_attribute([name](const pugi::xml_attribute& one) { return same_name(one.name(), name); });
}

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return std::string(text.substr(0, text.find_last_not_of(kBlanks) + 1));
}

class DepthWalker : public pugi::xml_tree_walker {
 public:
  bool for_each(pugi::xml_node&) override { return depth() < kMaxXmlDepth; }
};

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Result<MpcdiDocument> parse();

 private:
  int line_at(std::ptrdiff_t offset) const {
    return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + offset, '\n'));
  }
  int line_of(const pugi::xml_node& node) const { return line_at(std::max<std::ptrdiff_t>(node.offset_debug(), 0)); }
  Error error_at(const pugi::xml_node& node, const std::string& what) const {
    return Error(fmt::format("{}: {}", line_of(node), what));
  }

  Result<double> number(const pugi::xml_node& node, const std::string& name, const std::string& text) const;
  Result<double> number_attribute(const pugi::xml_node& node, const char* name) const;
  Result<int> resolution(const pugi::xml_node& region, const char* name) const;
  Status parse_region(const pugi::xml_node& node);
  Status parse_position(const pugi::xml_node& frame, MpcdiRegion& region) const;
  void parse_files(const pugi::xml_node& files, MpcdiRegion& region) const;
  Status parse_extension(const pugi::xml_node& root);

  std::string_view text_;
  std::map<std::string, pugi::xml_node, std::less<>> filesets_;  // of files, by region
  MpcdiDocument document_;
};

Result<double> Parser::number(const pugi::xml_node& node, const std::string& name, const std::string& text) const {
  const std::string word = trimmed(text);
  double value = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (failure != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return error_at(node, fmt::format("{}: \"{}\"; a finite number is needed", name, word));
  }
  return value;
}

Result<double> Parser::number_attribute(const pugi::xml_node& node, const char* name) const {
  const pugi::xml_attribute found = attribute(node, name);
  if (!found) return error_at(node, fmt::format("{}: is missing", name));
  return number(node, name, found.value());
}

Result<int> Parser::resolution(const pugi::xml_node& region, const char* name) const {
  LFD_TRY(const double value, number_attribute(region, name));
  if (value != std::floor(value) || value < 1 || value > kMaxImageSide_px) {
    return error_at(region,
                    fmt::format("{}: {}; a whole number from 1 to {} is needed", name, value, kMaxImageSide_px));
  }
  return static_cast<int>(value);
}

Status Parser::parse_position(const pugi::xml_node& frame, MpcdiRegion& region) const {
  std::array<double, 3> place{};
  constexpr std::array<const char*, 3> kNames{"posx", "posy", "posz"};
  for (std::size_t i = 0; i < place.size(); ++i) {
    const pugi::xml_node node = child(frame, kNames[i]);
    const std::string road = fmt::format("region {}: coordinateFrame: {}", region.id, kNames[i]);
    if (!node) return error_at(frame, road + ": is missing");
    LFD_TRY(place[i], number(node, road, node.child_value()));
  }
  region.position = Point3<Physical>{place[0], place[1], place[2]};
  return {};
}

void Parser::parse_files(const pugi::xml_node& files, MpcdiRegion& region) const {
  if (const pugi::xml_node warp = child(files, "geometryWarpFile")) {
    const auto text = [&warp](const char* name) { return trimmed(child(warp, name).child_value()); };
    region.warp_path = text("path");
    region.warp_unit = text("geometricUnit");
    region.warp_origin = text("originOf3DData");
    region.warp_interpolation = text("interpolation");
  }
  for (const char* name : {"alphaMap", "betaMap", "distortionMap"}) {
    if (child(files, name)) region.other_maps.emplace_back(name);
  }
}

Status Parser::parse_region(const pugi::xml_node& node) {
  MpcdiRegion region;
  region.line = line_of(node);
  region.id = attribute(node, "id").value();
  if (region.id.empty()) return error_at(node, "region: id: is missing");
  if (std::ranges::count(document_.regions, region.id, &MpcdiRegion::id) > 0) {
    return error_at(node, fmt::format("region {}: id: another region has it", region.id));
  }
  if (document_.regions.size() == kMaxModules) {
    return error_at(node, fmt::format("region {}: more than {} regions", region.id, kMaxModules));
  }
  const auto width = resolution(node, "xResolution"), height = resolution(node, "yResolution");
  if (!width) return width.error();
  if (!height) return height.error();
  region.resolution = {*width, *height};
  if (const pugi::xml_node frame = child(node, "coordinateFrame")) LFD_TRY_STATUS(parse_position(frame, region));
  parse_files(node, region);
  parse_files(child(node, "fileset"), region);
  if (const auto found = filesets_.find(region.id); found != filesets_.end()) parse_files(found->second, region);
  document_.regions.push_back(std::move(region));
  return {};
}

Status Parser::parse_extension(const pugi::xml_node& root) {
  for (const pugi::xml_node& one : child(root, "extensionSet")) {
    const pugi::xml_node node = child(one, kExtension);
    if (!node) continue;
    MpcdiExtension extension;
    extension.name = attribute(node, "name").value();
    LFD_TRY(extension.screen.width_m, number_attribute(node, "screenWidth"));
    LFD_TRY(extension.screen.height_m, number_attribute(node, "screenHeight"));
    LFD_TRY(extension.optics.screen_radius_m, number_attribute(node, "screenRadius"));
    LFD_TRY(extension.optics.observer_height_m, number_attribute(node, "observerHeight"));
    LFD_TRY(extension.optics.observer_distance_m, number_attribute(node, "observerDistance"));
    LFD_TRY(extension.angular_scattering_rad, number_attribute(node, "angularScattering"));
    const std::string_view arc = attribute(node, "observerArc").value();
    if (arc != "true" && arc != "false")
      return error_at(node, fmt::format("observerArc: \"{}\"; true or false is needed", arc));
    extension.optics.observer_arc = arc == "true";
    extension.line = line_of(node);
    const std::string_view diffuser = attribute(node, "diffuser").value();
    if (diffuser != "linear" && diffuser != "conical") {
      return error_at(node, fmt::format("diffuser: \"{}\"; linear or conical is needed", diffuser));
    }
    extension.optics.diffuser = diffuser == "linear" ? Diffuser::kLinear : Diffuser::kConical;
    document_.extension = extension;
  }
  return {};
}

Result<MpcdiDocument> Parser::parse() {
  pugi::xml_document xml;
  const pugi::xml_parse_result result =
      xml.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) return Error(fmt::format("{}: {}", line_at(result.offset), result.description()));
  DepthWalker walker;
  if (!xml.traverse(walker)) return Error(fmt::format("1: elements are nested deeper than {}", kMaxXmlDepth));
  const pugi::xml_node root = child(xml, "MPCDI");
  if (!root) return Error("1: no element MPCDI at the top");
  document_.profile = attribute(root, "profile").value();
  document_.version = attribute(root, "version").value();
  for (const pugi::xml_node& set : child(root, "files")) {
    if (same_name(set.name(), "fileset")) filesets_.emplace(attribute(set, "region").value(), set);
  }
  for (const pugi::xml_node& buffer : child(root, "display")) {
    if (!same_name(buffer.name(), "buffer")) continue;
    for (const pugi::xml_node& region : buffer) {
      if (same_name(region.name(), "region")) LFD_TRY_STATUS(parse_region(region));
    }
  }
  LFD_TRY_STATUS(parse_extension(root));
  return std::move(document_);
}

}  // namespace

Result<MpcdiDocument> parse_mpcdi_xml(std::string_view text) { return Parser(text).parse(); }

}  // namespace lfd
