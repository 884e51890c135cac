// Which foreign format a calibration file has, found from its content, and its import.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "calibration/display.h"

namespace lfd {

enum class ForeignFormat { kHolovizioJson, kLfdisplayYaml, kMpcdi };

// What begins like a ZIP archive ("PK") is MPCDI; a text whose first character that is no space is "{" is JSON; one
// with the directive %YAML or the key viewerdistance is YAML.
std::optional<ForeignFormat> foreign_format_of(std::string_view text);

// `file` is named in errors. MPCDI is imported without options, its warnings are dropped: see import_mpcdi.
Result<DisplayCalibration> import_display(ForeignFormat format, std::string_view text, const std::string& file);

}  // namespace lfd
