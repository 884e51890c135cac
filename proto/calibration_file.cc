// Display calibrations to and from messages, and to and from files.
#include "proto/calibration_file.h"

#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "proto/color_message.h"
#include "proto/text_file.h"

namespace lfd {
namespace {

template <class M>
Point3<Physical> read_point(const M& m) {
  return {m.x(), m.y(), m.z()};
}

void write_point(proto::Vector& to, Point3<Physical> p) {
  to.set_x(p.x);
  to.set_y(p.y);
  to.set_z(p.z);
}

Result<Diffuser> read_diffuser(proto::Optics::Diffuser diffuser) {
  if (diffuser == proto::Optics::LINEAR) return Diffuser::kLinear;
  if (diffuser == proto::Optics::CONICAL) return Diffuser::kConical;
  return Error("optics: diffuser: must be LINEAR or CONICAL");
}

Result<HomographyMap> read_homography(const proto::Homography& m) {
  if (m.h_size() != 9) return Error(fmt::format("h: {} numbers; 9 are needed", m.h_size()));
  HomographyMap map;
  for (int i = 0; i < 9; ++i) map.image_from_screen[i % 3][i / 3] = m.h(i);
  return map;
}

Result<PinholeMap> read_pinhole(const proto::Pinhole& m) {
  if (!m.has_position()) return Error("position: is missing");
  if (!m.has_orientation()) return Error("orientation: is missing");
  const auto& q = m.orientation();
  PinholeMap map;
  map.position = read_point(m.position());
  map.orientation = glm::dquat(q.w(), q.x(), q.y(), q.z());
  map.focal_u_px = m.focal_u_px();
  map.focal_v_px = m.focal_v_px();
  map.principal_u_px = m.principal_u_px();
  map.principal_v_px = m.principal_v_px();
  map.k1 = m.k1();
  map.k2 = m.k2();
  map.k3 = m.k3();
  map.p1 = m.p1();
  map.p2 = m.p2();
  return map;
}

Result<GridMap> read_grid(const proto::Grid& m) {
  if (!m.file().empty()) return Error(fmt::format("file: \"{}\" can only be read with the calibration file", m.file()));
  GridNodes nodes{m.columns(), m.rows(), m.first_u_px(), m.first_v_px(), m.step_u_px(), m.step_v_px(), {}};
  if (m.s_size() != m.y_size()) return Error(fmt::format("{} numbers s, but {} numbers y", m.s_size(), m.y_size()));
  nodes.node.reserve(static_cast<std::size_t>(m.s_size()));
  for (int i = 0; i < m.s_size(); ++i) nodes.node.push_back({m.s(i), m.y(i)});
  return GridMap::make(std::move(nodes));
}

Result<ScreenMap> read_map(const proto::Module& m) {
  switch (m.map_case()) {
    case proto::Module::kIdeal:
      return ScreenMap(IdealMap{});
    case proto::Module::kHomography: {
      const auto map = read_homography(m.homography());
      if (!map) return map.error().within("homography");
      return ScreenMap(*map);
    }
    case proto::Module::kPinhole: {
      const auto map = read_pinhole(m.pinhole());
      if (!map) return map.error().within("pinhole");
      return ScreenMap(*map);
    }
    case proto::Module::kGrid: {
      const auto map = read_grid(m.grid());
      if (!map) return map.error().within("grid");
      return ScreenMap(*map);
    }
    case proto::Module::MAP_NOT_SET:
      break;
  }
  return Error("one of ideal, homography, pinhole, grid is needed");
}

Result<ModuleCalibration> read_module(const proto::Module& m) {
  if (!m.has_emitter()) return Error("emitter: is missing");
  LFD_TRY(ScreenMap map, read_map(m));
  ModuleCalibration module{read_point(m.emitter()), map};
  if (!m.has_color()) return module;
  auto color = read_color(m.color());
  if (!color) return color.error().within("color");
  module.color = *std::move(color);
  return module;
}

void write_map(proto::Module& m, const IdealMap&) { m.mutable_ideal(); }

void write_map(proto::Module& m, const HomographyMap& map) {
  for (int i = 0; i < 9; ++i) m.mutable_homography()->add_h(map.image_from_screen[i % 3][i / 3]);
}

void write_map(proto::Module& m, const PinholeMap& map) {
  auto& pinhole = *m.mutable_pinhole();
  write_point(*pinhole.mutable_position(), map.position);
  pinhole.mutable_orientation()->set_w(map.orientation.w);
  pinhole.mutable_orientation()->set_x(map.orientation.x);
  pinhole.mutable_orientation()->set_y(map.orientation.y);
  pinhole.mutable_orientation()->set_z(map.orientation.z);
  pinhole.set_focal_u_px(map.focal_u_px);
  pinhole.set_focal_v_px(map.focal_v_px);
  pinhole.set_principal_u_px(map.principal_u_px);
  pinhole.set_principal_v_px(map.principal_v_px);
  pinhole.set_k1(map.k1);
  pinhole.set_k2(map.k2);
  pinhole.set_k3(map.k3);
  pinhole.set_p1(map.p1);
  pinhole.set_p2(map.p2);
}

void write_map(proto::Module& m, const GridMap& map) {
  const GridNodes& nodes = map.nodes();
  auto& grid = *m.mutable_grid();
  grid.set_columns(nodes.columns);
  grid.set_rows(nodes.rows);
  grid.set_first_u_px(nodes.first_u_px);
  grid.set_first_v_px(nodes.first_v_px);
  grid.set_step_u_px(nodes.step_u_px);
  grid.set_step_v_px(nodes.step_v_px);
  for (const ScreenPoint& s : nodes.node) {
    grid.add_s(s.x);
    grid.add_y(s.y);
  }
}

}  // namespace

Result<DisplayCalibration> read_calibration(const proto::DisplayCalibration& m) {
  DisplayCalibration display;
  display.name = m.name();
  display.screen = {m.screen().width_m(), m.screen().height_m()};
  display.image = {m.image().width_px(), m.image().height_px()};
  LFD_TRY(display.optics.diffuser, read_diffuser(m.optics().diffuser()));
  display.optics.observer_height_m = m.optics().observer_height_m();
  display.optics.observer_distance_m = m.optics().observer_distance_m();
  display.optics.screen_radius_m = m.optics().screen_radius_m();
  display.optics.observer_arc = m.optics().observer_arc();
  display.angular_scattering_rad = m.angular_scattering_rad();
  for (int k = 0; k < m.module_size(); ++k) {
    auto module = read_module(m.module(k));
    if (!module) return module.error().within(fmt::format("module {}", k));
    display.modules.push_back(*module);
  }
  LFD_TRY_STATUS(validate(display));
  return display;
}

proto::DisplayCalibration write_calibration(const DisplayCalibration& display) {
  proto::DisplayCalibration m;
  m.set_name(display.name);
  m.mutable_screen()->set_width_m(display.screen.width_m);
  m.mutable_screen()->set_height_m(display.screen.height_m);
  m.mutable_image()->set_width_px(display.image.width);
  m.mutable_image()->set_height_px(display.image.height);
  m.mutable_optics()->set_diffuser(display.optics.diffuser == Diffuser::kLinear ? proto::Optics::LINEAR
                                                                                : proto::Optics::CONICAL);
  m.mutable_optics()->set_observer_height_m(display.optics.observer_height_m);
  m.mutable_optics()->set_observer_distance_m(display.optics.observer_distance_m);
  m.mutable_optics()->set_screen_radius_m(display.optics.screen_radius_m);
  m.mutable_optics()->set_observer_arc(display.optics.observer_arc);
  m.set_angular_scattering_rad(display.angular_scattering_rad);
  for (const ModuleCalibration& module : display.modules) {
    auto& to = *m.add_module();
    write_point(*to.mutable_emitter(), module.emitter);
    std::visit([&to](const auto& map) { write_map(to, map); }, module.map);
    if (module.color) *to.mutable_color() = write_color(*module.color);
  }
  return m;
}

Result<DisplayCalibration> load_calibration(const std::filesystem::path& path) {
  proto::DisplayCalibration message;
  LFD_TRY(const TextPlaces places, read_text_file(path, message));
  if (auto status = read_grid_files(message, path.parent_path()); !status) return places.locate(status.error());
  auto display = read_calibration(message);
  if (!display) return places.locate(display.error());
  return display;
}

Status save_calibration(const std::filesystem::path& path, const DisplayCalibration& display,
                        std::optional<GridFileFormat> grids) {
  proto::DisplayCalibration message = write_calibration(display);
  if (grids) LFD_TRY_STATUS(write_grid_files(message, path.parent_path(), path.stem().string(), *grids));
  const std::string text = print_text(message);
  if (text.size() > kTextFileLimit_bytes) {
    return Error(
        fmt::format("{}: {} bytes, of which at most {} would be read again; put the grids into files beside it",
                    path.string(), text.size(), kTextFileLimit_bytes));
  }
  return write_file(path, text);
}

std::string calibration_hash(const DisplayCalibration& display) {
  return content_hash(write_calibration(display).SerializeAsString());
}

}  // namespace lfd
