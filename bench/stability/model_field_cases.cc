// Bad numbers in the models of other programs: HoloVizio's JSON, LFDisplay's YAML.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/log.h"
#include "bench/stability/file_fields.h"
#include "bench/stability/groups.h"
#include "bench/stability/harmless.h"
#include "calibration/import/holovizio_json.h"
#include "calibration/import/lfdisplay_yaml.h"

namespace lfd::bench {
namespace {

// A field, and the place of its number: between `before` and `end`. Where numbers that are right by themselves make no
// place for a module together, the error may name the other one.
struct Field {
  const char* name;
  const char* before;
  char end;
  const char* other = "";

  std::vector<std::string> words() const {
    std::vector<std::string> names{name};
    if (*other != '\0') names.emplace_back(other);
    return names;
  }
};

constexpr const char* kJson = R"({
  "num_projectors": 2,
  "image_size_x": 30,
  "image_size_y": 20,
  "observer_distance": 2000.0,
  "screen_size_x": 1000.0,
  "screen_size_y": 750.0,
  "angular_scattering": 0.1,
  "projectors_pos_x": [-100, 100],
  "projectors_pos_y": [0, 5],
  "projectors_pos_z": [-700, -710.5],
  "name": "Two"
}
)";

constexpr std::array<Field, 10> kJsonFields{{{"num_projectors", "\"num_projectors\": ", ','},
                                             {"image_size_x", "\"image_size_x\": ", ','},
                                             {"image_size_y", "\"image_size_y\": ", ','},
                                             {"observer_distance", "\"observer_distance\": ", ','},
                                             {"screen_size_x", "\"screen_size_x\": ", ','},
                                             {"screen_size_y", "\"screen_size_y\": ", ','},
                                             {"angular_scattering", "\"angular_scattering\": ", ','},
                                             {"projectors_pos_x[1]", "\"projectors_pos_x\": [-100, ", ']'},
                                             {"projectors_pos_y[1]", "\"projectors_pos_y\": [0, ", ']'},
                                             {"projectors_pos_z[1]", "\"projectors_pos_z\": [-700, ", ']'}}};

// JSON itself has no words for these of kBadTexts.
constexpr std::array kNoJson{"nan", "inf", "-inf", "", "1e", "0x10", "1;5", "--1"};

// The others, and values that are no numbers.
std::vector<std::string> json_values() {
  std::vector<std::string> values{"null", "true", "\"7\"", "[]", "{}"};
  for (const std::string text : kBadTexts) {
    if (std::ranges::find(kNoJson, text) == kNoJson.end()) values.push_back(text);
  }
  return values;
}

Result<std::string> harm_of_json(const std::string& text) {
  LFD_TRY(const DisplayCalibration display, import_holovizio_json(text, "f.json"));
  return harm_of(display);
}

void add_json_cases(const Field& field, StabilityCases& cases) {
  const TextSlot slot = slot_of(kJson, field.before, field.end);
  const std::string title = std::string("HoloVizio JSON: ") + field.name, place = fmt::format("f.json:{}", slot.line());
  const auto read = [slot](const std::string& value) { return harm_of_json(slot.with(value)); };
  cases.push_back(field_case(kTextGroup, {title, slot.sound, json_values(), field.words(), place + ": ", read}));
  // Text that is no JSON has no fields: its line must be named, in front or behind.
  cases.push_back(field_case(kTextGroup, {title + ", no JSON",
                                          slot.sound,
                                          {kNoJson.begin(), kNoJson.end()},
                                          {place, fmt::format("line {}", slot.line())},
                                          "f.json:",
                                          read}));
}

constexpr const char* kYaml =
    "%YAML:1.0\n"
    "---\n"
    "viewerdistance: 3000.\n"
    "resolution: [ 30, 20 ]\n"
    "halfphyssize: [ 800., 450. ]\n"
    "diffusionpower: [ 900., 0. ]\n"
    "diffusertype: linear\n"
    "projectorlines:\n"
    "   - { start:[ -900., -300., 4800. ], step:[ 75., 5., 10. ], number:2 }\n";

constexpr std::array<Field, 15> kYamlFields{{{"viewerdistance", "viewerdistance: ", '\n', "start[2]"},
                                             {"resolution[0]", "resolution: [ ", ','},
                                             {"resolution[1]", "resolution: [ 30, ", ' '},
                                             {"halfphyssize[0]", "halfphyssize: [ ", ','},
                                             {"halfphyssize[1]", "halfphyssize: [ 800., ", ' '},
                                             {"diffusionpower[0]", "diffusionpower: [ ", ','},
                                             {"diffusionpower[1]", "diffusionpower: [ 900., ", ' '},
                                             {"diffusertype", "diffusertype: ", '\n'},
                                             {"start[0]", "start:[ ", ',', "step[0]"},
                                             {"start[1]", "start:[ -900., ", ',', "step[1]"},
                                             {"start[2]", "start:[ -900., -300., ", ' ', "step[2]"},
                                             {"step[0]", "step:[ ", ',', "start[0]"},
                                             {"step[1]", "step:[ 75., ", ',', "start[1]"},
                                             {"step[2]", "step:[ 75., 5., ", ' ', "start[2]"},
                                             {"projectorlines[0]: number", "number:", ' '}}};

Result<std::string> harm_of_yaml(const std::string& text) {
  LFD_TRY(const DisplayCalibration display, import_lfdisplay_yaml(text, "f.yaml"));
  return harm_of(display);
}

StabilityCase yaml_case(const Field& field) {
  const TextSlot slot = slot_of(kYaml, field.before, field.end);
  std::vector<std::string> bad{".nan", ".inf", "-.inf", "~", "\"\"", "[]", "{}"};
  for (const std::string text : kBadTexts) {
    if (!text.empty()) bad.push_back(text);  // a key without a value is null, as ~ is
  }
  // The other field of the viewer's distance stands on another line.
  const bool is_elsewhere = std::string_view(field.name) == "viewerdistance";
  return field_case(kTextGroup, {std::string("LFDisplay YAML: ") + field.name, slot.sound, bad, field.words(),
                                 is_elsewhere ? "f.yaml:#: " : fmt::format("f.yaml:{}: ", slot.line()),
                                 [slot](const std::string& value) { return harm_of_yaml(slot.with(value)); }});
}

}  // namespace

void add_model_field_cases(StabilityCases& cases) {
  for (const Field& field : kJsonFields) add_json_cases(field, cases);
  for (const Field& field : kYamlFields) cases.push_back(yaml_case(field));
}

}  // namespace lfd::bench
