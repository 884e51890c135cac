// Printing of status.
#include "cli/status_table.h"

#include <vector>

#include "base/log.h"
#include "cli/setting_names.h"
#include "proto/module_ranges.h"
#include "proto/settings.h"

namespace lfd {
namespace {

std::string vector_text(const proto::Vector& v) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", v.x(), v.y(), v.z()); }

}  // namespace

std::string roi_text(const proto::RegionOfInterest& roi) {
  const proto::Quaternion& q = roi.world_orientation();
  const bool is_turned = roi.has_world_orientation() && (q.x() != 0 || q.y() != 0 || q.z() != 0);
  return fmt::format(
      "world     centre {}  size {}{}\nphysical  centre {}  size {}\n", vector_text(roi.world_centre()),
      vector_text(roi.world_size()),
      is_turned ? fmt::format("  orientation {:.6g},{:.6g},{:.6g},{:.6g}", q.w(), q.x(), q.y(), q.z()) : "",
      vector_text(roi.physical_centre()), vector_text(roi.physical_size()));
}

std::string method_text(const AoSettings& ao) {
  if (ao.is_chosen_by_budget()) return fmt::format("every node's own choice for {:g} ms", ao.budget_ms);
  std::string text(ao.method->name);
  for (std::size_t i = 0; i < ao.parameters.size(); ++i)
    text += fmt::format("{} {} {:g}", i == 0 ? ":" : ",", ao.method->parameters[i].name, ao.parameters[i]);
  return text;
}

std::string sharing_text(const AoSettings& ao) {
  if (ao.shared_neighbours == 0) return "no";
  return fmt::format("over +-{} modules{}", ao.shared_neighbours, ao.shared_open_air ? ", open air" : "");
}

std::string ao_text(const proto::AmbientOcclusion& message) {
  proto::RenderSettings render;
  *render.mutable_ao() = message;
  const auto settings = read_settings(render);
  if (!settings) return settings.error().message() + "\n";
  const AoSettings& ao = settings->ao;
  return fmt::format(
      "occlusion  {}{}\nmethod     {}\nradius     {}, {} radii\nsamples    {}{}, seed {}\n"
      "curve      a {:g}, b {:g}, c {:g}\nblur       {}\nguard band {} px\nshared     {}\ntarget     {}\n",
      !ao.enabled          ? "off"
      : ao.half_resolution ? "on, half resolution"
                           : "on",
      ao.enabled && ao.bent_normals ? ", bent normals" : "", method_text(ao),
      ao.radius_m > 0 ? fmt::format("{:g} m", ao.radius_m)
                      : fmt::format("{:g} of the region of interest's diagonal", ao.radius_roi),
      ao.radii,
      ao.samples > 0 ? fmt::format("{} per radius, {}", ao.samples, name_of(kGeneratorNames, message.generator()))
                     : "none",
      ao.least_samples > 0 ? fmt::format(", far away fewer, {} at least", ao.least_samples) : "", ao.seed, ao.curve.a,
      ao.curve.b, ao.curve.c, blur_text(ao), ao.guard_band_px, sharing_text(ao),
      name_of(kTargetNames, message.target()));
}

std::string pattern_text(const proto::TestPattern& message) {
  const auto pattern = read_pattern(message);
  if (!pattern) return pattern.error().message();
  if (!pattern->is_shown()) return "off";
  std::string text = name_of(kPatternNames, message.kind());
  if (pattern->kind == PatternKind::kGrid || pattern->kind == PatternKind::kChecker) {
    text += !pattern->on_screen      ? fmt::format(", {} px", pattern->spacing_px)
            : pattern->spacing_m > 0 ? fmt::format(", {:g} m on the screen", pattern->spacing_m)
                                     : ", a tenth of the screen's height";
  }
  text += fmt::format(", colour {:g},{:g},{:g}", pattern->color.r, pattern->color.g, pattern->color.b);
  if (!pattern->modules.empty()) text += fmt::format(", modules {}", fmt::join(message.modules(), ","));
  return text;
}

std::string status_table(const proto::Status& status) {
  std::string table;
  const auto line = [&](const char* name, const std::string& value) {
    table += fmt::format("{:<18}{}\n", name, value);
  };
  line("deployment", status.deployment());
  line("scene", status.scene());
  line("frame", std::to_string(status.frame()));
  line("frames per second", fmt::format("{:.2f} (unchanged ones included)", status.frames_per_second()));
  line("late frames", std::to_string(status.late_frames()));
  line("stale modules", std::to_string(status.stale_modules()));
  line("state", fmt::format("{} (update {})", status.state_hash(), status.sequence()));
  line("occlusion", status.render().ao().has_enabled() && !status.render().ao().enabled() ? "off" : "on");
  line("pattern", pattern_text(status.render().pattern()));
  table += roi_text(status.roi());
  for (const std::string& warning : status.scene_warning()) table += fmt::format("warning: {}\n", warning);
  table += fmt::format("\n{:<16} {:<8} {:<8} {:>8}  {:<34}{}\n", "peer", "role", "state", "process", "state hash",
                       "modules");
  for (const proto::PeerStatus& peer : status.peer()) {
    table +=
        fmt::format("{:<16} {:<8} {:<8} {:>8}  {:<34}{}\n", peer.name(),
                    peer.role() == proto::NODE ? "node" : "display", peer.state(), peer.process(), peer.state_hash(),
                    module_ranges(std::vector<int>(peer.module().begin(), peer.module().end())));
  }
  return table;
}

}  // namespace lfd
