// HoloVizio model files through nlohmann json (this is its door in calibration).
#include "calibration/import/holovizio_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/log.h"

namespace lfd {
namespace {

using nlohmann::json;

constexpr double kMetre = 1000;  // in millimetres

Result<json> member(const json& object, const char* field) {
  const auto found = object.find(field);
  if (found == object.end()) return Error(fmt::format("{}: is missing", field));
  return *found;
}

Result<double> number_of(const json& value, const std::string& place) {
  if (!value.is_number()) return Error(fmt::format("{}: must be a number, not {}", place, value.type_name()));
  const double number = value.get<double>();
  if (!std::isfinite(number)) return Error(fmt::format("{}: must be finite", place));
  return number;
}

Result<double> number(const json& object, const char* field) {
  LFD_TRY(const json value, member(object, field));
  return number_of(value, field);
}

Result<int> whole_number(const json& object, const char* field, int most) {
  LFD_TRY(const double value, number(object, field));
  if (value != std::floor(value) || value < 1 || value > most) {
    return Error(fmt::format("{}: {}; a whole number from 1 to {} is needed", field, value, most));
  }
  return static_cast<int>(value);
}

Result<std::vector<double>> numbers(const json& object, const char* field, int count) {
  LFD_TRY(const json list, member(object, field));
  if (!list.is_array()) return Error(fmt::format("{}: must be a list, not {}", field, list.type_name()));
  if (list.size() != static_cast<std::size_t>(count)) {
    return Error(fmt::format("{}: {} numbers, but num_projectors is {}", field, list.size(), count));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < list.size(); ++i) {
    LFD_TRY(const double value, number_of(list[i], fmt::format("{}[{}]", field, i)));
    values.push_back(value);
  }
  return values;
}

Result<DisplayCalibration> read_model(const json& model) {
  if (!model.is_object()) return Error("an object is needed at the top");
  DisplayCalibration display;
  LFD_TRY(const json name, member(model, "name"));
  if (!name.is_string()) return Error(fmt::format("name: must be a text, not {}", name.type_name()));
  display.name = name.get<std::string>();
  LFD_TRY(const int count, whole_number(model, "num_projectors", kMaxModules));
  LFD_TRY(display.image.width, whole_number(model, "image_size_x", kMaxImageSide_px));
  LFD_TRY(display.image.height, whole_number(model, "image_size_y", kMaxImageSide_px));
  LFD_TRY(const double distance, number(model, "observer_distance"));
  LFD_TRY(const double width, number(model, "screen_size_x"));
  LFD_TRY(const double height, number(model, "screen_size_y"));
  LFD_TRY(display.angular_scattering_rad, number(model, "angular_scattering"));
  display.optics = {Diffuser::kLinear, 0, distance / kMetre};
  display.screen = {width / kMetre, height / kMetre};
  LFD_TRY(const auto x, numbers(model, "projectors_pos_x", count));
  LFD_TRY(const auto y, numbers(model, "projectors_pos_y", count));
  LFD_TRY(const auto z, numbers(model, "projectors_pos_z", count));
  for (std::size_t k = 0; k < x.size(); ++k) {
    display.modules.push_back({{x[k] / kMetre, y[k] / kMetre, z[k] / kMetre}, IdealMap{}});
  }
  LFD_TRY_STATUS(validate(display));
  return display;
}

}  // namespace

Result<DisplayCalibration> import_holovizio_json(std::string_view text, const std::string& file) {
  try {
    auto display = read_model(json::parse(text));
    if (!display) return display.error().within(file);
    return display;
  } catch (const json::exception& failure) {
    // parse_error says line and column
    return Error(failure.what()).within(file);
  }
}

}  // namespace lfd
