// HoloVizio model files through nlohmann json (this is its door in calibration).
#include "calibration/import/holovizio_json.h"

#include <cmath>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/log.h"
#include "calibration/import/foreign_fields.h"

namespace lfd {
namespace {

using nlohmann::json;

constexpr double kMetre = 1000;  // in millimetres

// The line of the last character that was taken from a text; a line break is of the line that it ends.
struct LineCount {
  int line = 1;
  bool has_ended = false;
};

// An iterator that counts the lines it passes: nlohmann json says only in its errors where it is.
class CountedText {
 public:
  using difference_type = std::ptrdiff_t;
  using value_type = char;
  using pointer = const char*;
  using reference = const char&;
  using iterator_category = std::input_iterator_tag;

  CountedText() = default;
  CountedText(const char* at, LineCount& count) : at_(at), count_(&count) {}
  reference operator*() const { return *at_; }
  CountedText& operator++() {
    if (count_->has_ended) ++count_->line;
    count_->has_ended = *at_ == '\n';
    ++at_;
    return *this;
  }
  CountedText operator++(int) {
    CountedText before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountedText& other) const { return at_ == other.at_; }
  bool operator!=(const CountedText& other) const { return at_ != other.at_; }

 private:
  const char* at_ = nullptr;
  LineCount* count_ = nullptr;
};

// The text's values, and the lines of the fields of the object at the top ("name") and of the elements of their lists
// ("name[3]").
struct ParsedText {
  json object;
  std::map<std::string, int> lines;
};

// Error: a number beyond any double. Throws json::parse_error where the text is no JSON.
Result<ParsedText> parse(std::string_view text) {
  LineCount count;
  ParsedText parsed;
  std::string field;
  int element = -1;  // the next one of the field's list; -1: not in a list
  const auto note = [&](int depth, json::parse_event_t event, json& value) {
    using Event = json::parse_event_t;
    if (depth == 1) {
      if (event == Event::key) parsed.lines.insert_or_assign(field = value.get<std::string>(), count.line);
      element = event == Event::array_start ? 0 : -1;
    } else if (depth == 2 && element >= 0 && event != Event::array_end && event != Event::object_end) {
      parsed.lines.insert_or_assign(fmt::format("{}[{}]", field, element++), count.line);
    }
    return true;
  };
  try {
    parsed.object = json::parse(CountedText(text.data(), count), CountedText(text.data() + text.size(), count), note);
  } catch (const json::out_of_range&) {
    const std::string place = element >= 0 ? fmt::format("{}[{}]", field, element) : field;
    return Error(fmt::format("{}: {}: must be a number that a double can hold", count.line, place));
  }
  return parsed;
}

// A model of which every error begins with a line and the field's name.
class Model {
 public:
  explicit Model(ParsedText text) : object_(std::move(text.object)), lines_(std::move(text.lines)) {}

  Result<DisplayCalibration> read() const;

 private:
  int line_of(const std::string& field) const {
    const auto found = lines_.find(field);
    return found == lines_.end() ? 1 : found->second;
  }
  Error error_at(const std::string& field, const std::string& what) const {
    return Error(fmt::format("{}: {}: {}", line_of(field), field, what));
  }
  Result<json> member(const std::string& field) const;
  Result<double> number_of(const json& value, const std::string& field) const;
  Result<double> number(const std::string& field) const;
  Result<int> whole_number(const std::string& field, int most) const;
  Result<std::vector<double>> numbers(const std::string& field, int count) const;
  Error foreign_error(const Error& error, std::size_t modules) const;

  json object_;
  std::map<std::string, int> lines_;
};

Result<json> Model::member(const std::string& field) const {
  const auto found = object_.find(field);
  if (found == object_.end()) return error_at(field, "is missing");
  return *found;
}

Result<double> Model::number_of(const json& value, const std::string& field) const {
  if (!value.is_number()) return error_at(field, fmt::format("must be a number, not {}", value.type_name()));
  const double number = value.get<double>();
  if (!std::isfinite(number)) return error_at(field, "must be finite");
  return number;
}

Result<double> Model::number(const std::string& field) const {
  LFD_TRY(const json value, member(field));
  return number_of(value, field);
}

Result<int> Model::whole_number(const std::string& field, int most) const {
  LFD_TRY(const double value, number(field));
  if (value != std::floor(value) || value < 1 || value > most)
    return error_at(field, fmt::format("{}; a whole number from 1 to {} is needed", value, most));
  return static_cast<int>(value);
}

Result<std::vector<double>> Model::numbers(const std::string& field, int count) const {
  LFD_TRY(const json list, member(field));
  if (!list.is_array()) return error_at(field, fmt::format("must be a list, not {}", list.type_name()));
  if (list.size() != static_cast<std::size_t>(count))
    return error_at(field, fmt::format("{} numbers, but num_projectors is {}", list.size(), count));
  std::vector<double> values;
  for (std::size_t i = 0; i < list.size(); ++i) {
    LFD_TRY(const double value, number_of(list[i], fmt::format("{}[{}]", field, i)));
    values.push_back(value);
  }
  return values;
}

// Errors of the display as a whole, in the file's words.
Error Model::foreign_error(const Error& error, std::size_t modules) const {
  std::vector<ForeignField> fields;
  const auto add = [&](const std::string& road, const std::string& field) {
    fields.push_back({road, line_of(field), field});
  };
  add("screen: width_m", "screen_size_x");
  add("screen: height_m", "screen_size_y");
  add("optics: observer_distance_m", "observer_distance");
  add("angular_scattering_rad", "angular_scattering");
  for (std::size_t k = 0; k < modules; ++k) {
    for (const char axis : {'x', 'y', 'z'})
      add(fmt::format("module {}: emitter: {}", k, axis), fmt::format("projectors_pos_{}[{}]", axis, k));
  }
  return in_foreign_words(error, fields);
}

Result<DisplayCalibration> Model::read() const {
  if (!object_.is_object()) return Error("1: an object is needed at the top");
  DisplayCalibration display;
  LFD_TRY(const json name, member("name"));
  if (!name.is_string()) return error_at("name", fmt::format("must be a text, not {}", name.type_name()));
  display.name = name.get<std::string>();
  LFD_TRY(const int count, whole_number("num_projectors", kMaxModules));
  LFD_TRY(display.image.width, whole_number("image_size_x", kMaxImageSide_px));
  LFD_TRY(display.image.height, whole_number("image_size_y", kMaxImageSide_px));
  LFD_TRY(const double distance, number("observer_distance"));
  LFD_TRY(const double width, number("screen_size_x"));
  LFD_TRY(const double height, number("screen_size_y"));
  LFD_TRY(display.angular_scattering_rad, number("angular_scattering"));
  display.optics = {Diffuser::kLinear, 0, distance / kMetre};
  display.screen = {width / kMetre, height / kMetre};
  LFD_TRY(const auto x, numbers("projectors_pos_x", count));
  LFD_TRY(const auto y, numbers("projectors_pos_y", count));
  LFD_TRY(const auto z, numbers("projectors_pos_z", count));
  for (std::size_t k = 0; k < x.size(); ++k) {
    display.modules.push_back({{x[k] / kMetre, y[k] / kMetre, z[k] / kMetre}, IdealMap{}});
  }
  if (const Status status = validate(display); !status) return foreign_error(status.error(), display.modules.size());
  return display;
}

}  // namespace

Result<DisplayCalibration> import_holovizio_json(std::string_view text, const std::string& file) {
  try {
    auto parsed = parse(text);
    if (!parsed) return Error(fmt::format("{}:{}", file, parsed.error().message()));
    auto display = Model(*std::move(parsed)).read();
    if (!display) return Error(fmt::format("{}:{}", file, display.error().message()));
    return display;
  } catch (const json::exception& failure) {
    // parse_error says line and column
    return Error(failure.what()).within(file);
  }
}

}  // namespace lfd
