// Colour calibrations to and from messages.
#include "proto/color_message.h"

#include "base/log.h"

namespace lfd {
namespace {

Result<GainMap> read_gain(const proto::GainMap& m) {
  if (m.r_size() != m.g_size() || m.r_size() != m.b_size())
    return Error(fmt::format("{} numbers r, {} numbers g, {} numbers b", m.r_size(), m.g_size(), m.b_size()));
  GainMap map{m.columns(), m.rows(), {}};
  map.node.reserve(static_cast<std::size_t>(m.r_size()));
  for (int i = 0; i < m.r_size(); ++i) map.node.emplace_back(m.r(i), m.g(i), m.b(i));
  return map;
}

Result<TransferCurve> read_curve(const proto::TransferCurve& m) {
  if (m.has_gamma() && m.drive_size() > 0) return Error("gamma and drive are given; only one of them is possible");
  if (m.has_gamma()) return TransferCurve(GammaCurve{m.gamma()});
  if (m.drive_size() > 0) return TransferCurve(TableCurve{{m.drive().begin(), m.drive().end()}});
  return Error("one of gamma, drive is needed");
}

// `message` makes the curve's message; it is not called for sRGB, which has none.
template <class Message>
void write_curve(const TransferCurve& curve, Message message) {
  if (const auto* gamma = std::get_if<GammaCurve>(&curve)) message()->set_gamma(gamma->gamma);
  if (const auto* table = std::get_if<TableCurve>(&curve))
    message()->mutable_drive()->Add(table->drive.begin(), table->drive.end());
}

}  // namespace

Result<ColorCalibration> read_color(const proto::ColorCalibration& m) {
  ColorCalibration color;
  if (m.has_gain()) {
    auto gain = read_gain(m.gain());
    if (!gain) return gain.error().within("gain");
    color.gain = *std::move(gain);
  }
  if (m.black_level_size() != 0 && m.black_level_size() != 3)
    return Error(fmt::format("black_level: {} numbers; 3 are needed", m.black_level_size()));
  for (int c = 0; c < m.black_level_size(); ++c) color.black_level[c] = m.black_level(c);
  const int entries = m.device_from_display_size();
  if (entries != 0 && entries != 9) return Error(fmt::format("device_from_display: {} numbers; 9 are needed", entries));
  for (int i = 0; i < entries; ++i) color.device_from_display[i % 3][i / 3] = m.device_from_display(i);
  struct Channel {
    const char* name;
    bool is_there;
    const proto::TransferCurve& curve;
  };
  const Channel channels[] = {
      {"red", m.has_red(), m.red()}, {"green", m.has_green(), m.green()}, {"blue", m.has_blue(), m.blue()}};
  for (std::size_t c = 0; c < 3; ++c) {
    if (!channels[c].is_there) continue;
    auto curve = read_curve(channels[c].curve);
    if (!curve) return curve.error().within(channels[c].name);
    color.curve[c] = *std::move(curve);
  }
  return color;
}

proto::ColorCalibration write_color(const ColorCalibration& color) {
  proto::ColorCalibration m;
  auto& gain = *m.mutable_gain();
  gain.set_columns(color.gain.columns);
  gain.set_rows(color.gain.rows);
  for (const glm::dvec3& node : color.gain.node) {
    gain.add_r(node.r);
    gain.add_g(node.g);
    gain.add_b(node.b);
  }
  for (int c = 0; c < 3; ++c) m.add_black_level(color.black_level[c]);
  for (int i = 0; i < 9; ++i) m.add_device_from_display(color.device_from_display[i % 3][i / 3]);
  write_curve(color.curve[0], [&m] { return m.mutable_red(); });
  write_curve(color.curve[1], [&m] { return m.mutable_green(); });
  write_curve(color.curve[2], [&m] { return m.mutable_blue(); });
  return m;
}

}  // namespace lfd
