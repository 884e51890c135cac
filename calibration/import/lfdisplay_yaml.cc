// LFDisplay files through yaml-cpp (this is its door).
#include "calibration/import/lfdisplay_yaml.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "base/log.h"
#include "calibration/import/foreign_fields.h"

namespace lfd {
namespace {

constexpr double kMetre = 1000;  // in millimetres

// Errors of values carry their line in front: ":9: field: what is wrong"; the file's name completes them.
Error error_at(const YAML::Node& node, const std::string& what) {
  return Error(node.Mark().is_null() ? ": " + what : fmt::format(":{}: {}", node.Mark().line + 1, what));
}

Result<YAML::Node> member(const YAML::Node& map, const std::string& field, const std::string& road = "") {
  const YAML::Node value = map[field];
  if (!value) return error_at(map, road + field + ": is missing");
  return value;
}

Result<double> number_of(const YAML::Node& node, const std::string& road) {
  double number = 0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, number))
    return error_at(node, road + ": must be a number");
  if (!std::isfinite(number)) return error_at(node, road + ": must be finite");
  return number;
}

Result<int> whole_number_of(const YAML::Node& node, const std::string& road, int most) {
  LFD_TRY(const double value, number_of(node, road));
  if (value != std::floor(value) || value < 1 || value > most) {
    return error_at(node, fmt::format("{}: {}; a whole number from 1 to {} is needed", road, value, most));
  }
  return static_cast<int>(value);
}

template <std::size_t kCount>
Result<std::array<double, kCount>> numbers(const YAML::Node& map, const std::string& field,
                                           const std::string& road = "") {
  LFD_TRY(const YAML::Node list, member(map, field, road));
  if (!list.IsSequence() || list.size() != kCount) {
    return error_at(list, fmt::format("{}{}: a list of {} numbers is needed", road, field, kCount));
  }
  std::array<double, kCount> values{};
  for (std::size_t i = 0; i < kCount; ++i) {
    LFD_TRY(values[i], number_of(list[i], fmt::format("{}{}[{}]", road, field, i)));
  }
  return values;
}

Result<Diffuser> diffuser_of(const YAML::Node& root) {
  LFD_TRY(const YAML::Node node, member(root, "diffusertype"));
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  if (text == "linear") return Diffuser::kLinear;
  if (text == "conical") return Diffuser::kConical;
  return error_at(node, "diffusertype: must be linear or conical");
}

// An error of the emitter `number` of a line, in the file's words: "start[2] + 3 step[2]: ...".
Error emitter_error(const YAML::Node& line, const std::string& road, int number, const Error& error) {
  constexpr std::string_view kRoad = "emitter: ";
  const std::string& message = error.message();
  const char axis = message.at(kRoad.size());
  return error_at(line, fmt::format("{}start[{}] + {} step[{}]: {}", road, axis - 'x', number, axis - 'x',
                                    message.substr(kRoad.size())));
}

Status add_line(const YAML::Node& line, const std::string& road, double viewer_distance, DisplayCalibration& display) {
  if (!line.IsMap()) return error_at(line, road + "{start, step, number} is needed");
  LFD_TRY(const auto start, numbers<3>(line, "start", road));
  LFD_TRY(const auto step, numbers<3>(line, "step", road));
  LFD_TRY(const YAML::Node count_node, member(line, "number", road));
  const int room = kMaxModules - static_cast<int>(display.modules.size());
  LFD_TRY(const int count, whole_number_of(count_node, road + "number", room));
  for (int i = 0; i < count; ++i) {
    const double z = viewer_distance - (start[2] + i * step[2]);
    const Emitter emitter{(start[0] + i * step[0]) / kMetre, (start[1] + i * step[1]) / kMetre, z / kMetre};
    if (const Status status = validate(emitter); !status) return emitter_error(line, road, i, status.error());
    display.modules.push_back({emitter, IdealMap{}});
  }
  return {};
}

Result<double> scattering_of(const YAML::Node& root) {
  LFD_TRY(const auto power, numbers<2>(root, "diffusionpower"));
  if (!(power[0] > 0)) return error_at(root["diffusionpower"], "diffusionpower[0]: must be positive");
  return 1.11741 / std::sqrt(power[0]);
}

// Errors of the display as a whole, in the file's words.
Error foreign_error(const YAML::Node& root, const Error& error) {
  const auto line = [](const YAML::Node& node) { return node.Mark().line + 1; };
  const Error said =
      in_foreign_words(error, {{"screen: width_m", line(root["halfphyssize"][0]), "halfphyssize[0]"},
                               {"screen: height_m", line(root["halfphyssize"][1]), "halfphyssize[1]"},
                               {"image: width_px", line(root["resolution"][0]), "resolution[0]"},
                               {"image: height_px", line(root["resolution"][1]), "resolution[1]"},
                               {"optics: observer_distance_m", line(root["viewerdistance"]), "viewerdistance"},
                               {"angular_scattering_rad", line(root["diffusionpower"]), "diffusionpower[0]"},
                               {"module", line(root["projectorlines"]), "projectorlines"}});
  return Error(":" + said.message());
}

Result<DisplayCalibration> read_configuration(const YAML::Node& root) {
  if (!root.IsMap()) return error_at(root, "keys with values are needed at the top");
  DisplayCalibration display;
  LFD_TRY(const YAML::Node distance_node, member(root, "viewerdistance"));
  LFD_TRY(const double distance, number_of(distance_node, "viewerdistance"));
  LFD_TRY(const YAML::Node resolution, member(root, "resolution"));
  if (!resolution.IsSequence() || resolution.size() != 2)
    return error_at(resolution, "resolution: 2 numbers are needed");
  LFD_TRY(display.image.width, whole_number_of(resolution[0], "resolution[0]", kMaxImageSide_px));
  LFD_TRY(display.image.height, whole_number_of(resolution[1], "resolution[1]", kMaxImageSide_px));
  LFD_TRY(const auto half, numbers<2>(root, "halfphyssize"));
  display.screen = {2 * half[0] / kMetre, 2 * half[1] / kMetre};
  LFD_TRY(display.angular_scattering_rad, scattering_of(root));
  LFD_TRY(display.optics.diffuser, diffuser_of(root));
  display.optics.observer_distance_m = distance / kMetre;
  LFD_TRY(const YAML::Node lines, member(root, "projectorlines"));
  if (!lines.IsSequence()) return error_at(lines, "projectorlines: must be a list");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    LFD_TRY_STATUS(add_line(lines[i], fmt::format("projectorlines[{}]: ", i), distance, display));
  }
  if (auto status = validate(display); !status) return foreign_error(root, status.error());
  return display;
}

bool is_key_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

std::string plain_yaml_of_opencv(std::string_view text) {
  std::string plain;
  bool line_start = true, in_comment = false;
  char quote = 0, before = '\n';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (line_start && text.substr(i).starts_with("%YAML")) {
      i = std::min(text.find('\n', i), text.size()) - 1;
      line_start = false;
      continue;
    }
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if ((c == '"' || c == '\'') && !in_comment) {
      quote = c;
    } else if (c == '#' && std::isspace(static_cast<unsigned char>(before)) != 0) {
      in_comment = true;
    }
    if (c == '\n') in_comment = false;
    plain += c;
    const bool last = i + 1 == text.size();
    if (c == ':' && quote == 0 && !in_comment && is_key_letter(before) && !last &&
        std::isspace(static_cast<unsigned char>(text[i + 1])) == 0) {
      plain += ' ';
    }
    line_start = c == '\n';
    before = c;
  }
  return plain;
}

Result<DisplayCalibration> import_lfdisplay_yaml(std::string_view text, const std::string& file) {
  try {
    auto display = read_configuration(YAML::Load(plain_yaml_of_opencv(text)));
    if (!display) return Error(file + display.error().message());
    display->name = std::filesystem::path(file).stem().string();
    return display;
  } catch (const YAML::Exception& failure) {
    return Error(fmt::format("{}:{}: {}", file, failure.mark.line + 1, failure.msg));
  }
}

}  // namespace lfd
