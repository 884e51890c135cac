// Test patterns as settings, with defaults filled in and every number checked.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "base/result.h"
#include "proto/module_ranges.h"
#include "proto/settings.pb.h"

namespace lfd {

enum class PatternKind { kNone, kNumber, kGrid, kChecker, kSolid };

// The meaning of each number: settings.proto.
struct PatternSettings {
  PatternKind kind = PatternKind::kNone;
  bool on_screen = false;  // in space SCREEN
  int spacing_px = 32;
  double spacing_m = 0;              // 0: a tenth of the screen's height
  glm::vec3 color{1};                // as modules are fed it
  std::vector<ModuleRange> modules;  // empty: all
  bool operator==(const PatternSettings&) const = default;

  bool is_shown() const { return kind != PatternKind::kNone; }
  // Of a pattern that is shown: whether this module shows it, or is black.
  bool is_shown_by(int module) const;
};

// Errors name the field: "pattern.spacing_px: -3; 1 to 8192 are possible".
Result<PatternSettings> read_pattern(const proto::TestPattern& message);

// Refuses modules that the display does not have: "pattern.modules 0: 8; the display has modules 0 to 7".
Status check_modules(const PatternSettings& pattern, int module_count);

}  // namespace lfd
