// Listing and running the cases.
#include "bench/stability/suite.h"

#include <algorithm>
#include <map>

#include "base/log.h"
#include "bench/common/built_commit.h"
#include "bench/stability/groups.h"
#include "rendernode/gl/context.h"

namespace lfd::bench {

namespace {

void gather_groups(StabilityCases& cases) {
  std::map<std::string, std::size_t> place;
  for (const StabilityCase& one : cases) place.emplace(one.group, place.size());
  std::ranges::stable_sort(cases, {}, [&](const StabilityCase& one) { return place.at(one.group); });
}

}  // namespace

StabilityCases stability_cases() {
  StabilityCases cases;
  add_limit_cases(cases);
  add_roi_cases(cases);
  add_radius_cases(cases);
  add_grid_cases(cases);
  add_distortion_cases(cases);
  add_field_cases(cases);
  add_scene_field_cases(cases);
  add_text_field_cases(cases);
  add_mpcdi_field_cases(cases);
  add_model_field_cases(cases);
  add_grid_file_field_cases(cases);
  add_gpu_map_cases(cases);
  add_module_cases(cases);
  add_end_cases(cases);
  add_map_picture_cases(cases);
  add_picture_cases(cases);
  add_triangle_cases(cases);
  add_occlusion_cases(cases);
  gather_groups(cases);
  return cases;
}

std::vector<std::string> StabilityTable::missed() const {
  std::vector<std::string> names;
  for (const StabilityRow& row : rows) {
    if (!row.outcome.passed) names.push_back(row.group + ": " + row.name);
  }
  return names;
}

Result<StabilityTable> run_stability(int gpu) {
  LFD_TRY(const std::unique_ptr<gl::Context> context, gl::Context::create(gpu));
  StabilityTable table{context->description(), built_version(), {}};
  std::string group;
  for (const StabilityCase& one : stability_cases()) {
    if (one.group != std::exchange(group, one.group)) log::info("{}", group);
    table.rows.push_back({one.group, one.name, one.expected, one.run(*context)});
  }
  return table;
}

}  // namespace lfd::bench
