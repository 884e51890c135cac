// Test patterns out of messages.
#include "proto/pattern.h"

#include <algorithm>

#include "proto/check_range.h"

namespace lfd {
namespace {

constexpr double kMostSpacing_px = 8192;
constexpr double kLeastSpacing_m = 1e-6, kMostSpacing_m = 1e4;

// That something is shown, if anything is said of it; and what it is made of.
Status check_kind(const proto::TestPattern& m) {
  LFD_TRY_STATUS(check_range("pattern.kind", m.kind(), 0, 4));
  LFD_TRY_STATUS(check_range("pattern.space", m.space(), 0, 1));
  const bool is_empty = m.ByteSizeLong() == 0;
  if (m.kind() == proto::TestPattern::NONE && !is_empty)
    return Error("pattern.kind: is missing or NONE beside other fields; NUMBER, GRID, CHECKER and SOLID are possible");
  return {};
}

Status check_spacing(const proto::TestPattern& m) {
  const bool has_spacing = m.kind() == proto::TestPattern::GRID || m.kind() == proto::TestPattern::CHECKER;
  const bool on_screen = m.space() == proto::TestPattern::SCREEN;
  if (on_screen && !has_spacing) return Error("pattern.space: SCREEN is for kind GRID or CHECKER only");
  if (m.spacing_px() != 0) {
    if (!has_spacing || on_screen) return Error("pattern.spacing_px: is for kind GRID or CHECKER in space IMAGE only");
    LFD_TRY_STATUS(check_range("pattern.spacing_px", m.spacing_px(), 1, kMostSpacing_px));
  }
  if (m.spacing_m() != 0) {
    if (!on_screen) return Error("pattern.spacing_m: is for kind GRID or CHECKER in space SCREEN only");
    LFD_TRY_STATUS(check_range("pattern.spacing_m", m.spacing_m(), kLeastSpacing_m, kMostSpacing_m));
  }
  return {};
}

}  // namespace

bool PatternSettings::is_shown_by(int module) const {
  return modules.empty() || std::ranges::any_of(modules, [&](const ModuleRange& one) { return one.contains(module); });
}

Result<PatternSettings> read_pattern(const proto::TestPattern& m) {
  PatternSettings pattern;
  LFD_TRY_STATUS(check_kind(m));
  LFD_TRY_STATUS(check_spacing(m));
  pattern.kind = static_cast<PatternKind>(m.kind());
  pattern.on_screen = m.space() == proto::TestPattern::SCREEN;
  if (m.spacing_px() != 0) pattern.spacing_px = m.spacing_px();
  pattern.spacing_m = m.spacing_m();
  if (m.has_color()) {
    for (const double part : {m.color().r(), m.color().g(), m.color().b()})
      LFD_TRY_STATUS(check_range("pattern.color", part, 0, 1));
    pattern.color = {m.color().r(), m.color().g(), m.color().b()};
  }
  for (int i = 0; i < m.modules_size(); ++i) {
    const auto range = parse_range(m.modules(i));
    if (!range) return range.error().within(fmt::format("pattern.modules {}", i));
    pattern.modules.push_back(*range);
  }
  return pattern;
}

Status check_modules(const PatternSettings& pattern, int module_count) {
  for (std::size_t i = 0; i < pattern.modules.size(); ++i) {
    if (const Status there = check_within_display(pattern.modules[i], module_count); !there)
      return there.error().within(fmt::format("pattern.modules {}", i));
  }
  return {};
}

}  // namespace lfd
