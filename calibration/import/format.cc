// Formats told apart.
#include "calibration/import/format.h"

#include "calibration/import/holovizio_json.h"
#include "calibration/import/lfdisplay_yaml.h"
#include "calibration/import/mpcdi.h"

namespace lfd {

std::optional<ForeignFormat> foreign_format_of(std::string_view text) {
  if (text.starts_with("PK\x03\x04")) return ForeignFormat::kMpcdi;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && text[first] == '{') return ForeignFormat::kHolovizioJson;
  if (text.starts_with("%YAML") || text.find("viewerdistance") != text.npos) return ForeignFormat::kLfdisplayYaml;
  return std::nullopt;
}

Result<DisplayCalibration> import_display(ForeignFormat format, std::string_view text, const std::string& file) {
  switch (format) {
    case ForeignFormat::kHolovizioJson:
      return import_holovizio_json(text, file);
    case ForeignFormat::kLfdisplayYaml:
      return import_lfdisplay_yaml(text, file);
    case ForeignFormat::kMpcdi:
      break;
  }
  LFD_TRY(MpcdiImport import, import_mpcdi(text, file, {}));
  return std::move(import.display);
}

}  // namespace lfd
