// Printing of status.
#include "cli/status_table.h"

#include <vector>

#include "base/log.h"
#include "base/printable.h"
#include "cli/setting_names.h"
#include "cli/watch_table.h"
#include "proto/module_ranges.h"
#include "proto/settings.h"

namespace lfd {
namespace {

std::string vector_text(const proto::Vector& v) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", v.x(), v.y(), v.z()); }

// How fast each of them is, and what went wrong last.
std::string figures_of_peers(const proto::Status& status) {
  std::string table = fmt::format("{:<16} {:>6} {:>9} {:>6} {:>14}  {}\n", "peer", "fps", "ready ms", "stale",
                                  "image bytes", "stages, ms");
  for (const proto::PeerStatus& peer : status.peer()) {
    table +=
        fmt::format("{:<16} {:>6.1f} {:>9.1f} {:>6} {:>14}  {}\n", printable(peer.name()), peer.frames_per_second(),
                    peer.begin_to_ready_ms(), peer.stale_modules(), peer.image_bytes(), stages_text(peer, 20));
  }
  for (const proto::PeerStatus& peer : status.peer()) {
    if (!peer.last_fault().empty())
      table += fmt::format("last fault of \"{}\": {}\n", printable(peer.name()), printable(peer.last_fault()));
  }
  return table;
}

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
  // With a budget what nobody asks for comes with the settings that a node chooses.
  const auto unless_chosen = [&](bool is_asked, std::string text) {
    return ao.is_chosen_by_budget() && !is_asked ? std::string("every node's own choice") : std::move(text);
  };
  const std::string samples =
      ao.samples > 0 ? fmt::format("{} per radius, {}", ao.samples, name_of(kGeneratorNames, message.generator()))
                     : "none";
  std::string text = fmt::format("occlusion  {}{}\n",
                                 !ao.enabled          ? "off"
                                 : ao.half_resolution ? "on, half resolution"
                                                      : "on",
                                 ao.enabled && ao.bent_normals ? ", bent normals" : "");
  text += fmt::format("method     {}\n", method_text(ao));
  text += fmt::format("radius     {}, {}\n",
                      ao.radius_m > 0 ? fmt::format("{:g} m", ao.radius_m)
                                      : fmt::format("{:g} of the region of interest's diagonal", ao.radius_roi),
                      ao.is_chosen_by_budget() && message.radii() == 0 ? "as many radii as every node chooses"
                                                                       : fmt::format("{} radii", ao.radii));
  text +=
      fmt::format("samples    {}{}, seed {}\n", unless_chosen(false, samples),
                  ao.least_samples > 0 ? fmt::format(", far away fewer, {} at least", ao.least_samples) : "", ao.seed);
  text += fmt::format(
      "curve      {}\n",
      unless_chosen(message.has_curve(), fmt::format("a {:g}, b {:g}, c {:g}", ao.curve.a, ao.curve.b, ao.curve.c)));
  text += fmt::format("blur       {}\n", unless_chosen(message.has_blur(), blur_text(ao)));
  text += fmt::format("guard band {} px\n", ao.guard_band_px);
  text += fmt::format("shared     {}\n", unless_chosen(message.has_shared(), sharing_text(ao)));
  return text + fmt::format("target     {}\n", name_of(kTargetNames, message.target()));
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
    table += fmt::format("{:<18}{}\n", name, printable(value));
  };
  line("deployment", status.deployment());
  line("scene", status.scene());
  line("up", fmt::format("{:.0f} s", status.up_s()));
  line("frame", std::to_string(status.frame()));
  line("shown frames", std::to_string(status.shown_frames()));
  line("frames per second", fmt::format("{:.2f} (unchanged ones included)", status.frames_per_second()));
  line("begin to swap", fmt::format("{:.1f} ms", status.begin_to_swap_ms()));
  line("begin to shown", fmt::format("{:.1f} ms", status.begin_to_shown_ms()));
  line("late frames", std::to_string(status.late_frames()));
  line("stale modules", std::to_string(status.stale_modules()));
  line("state", fmt::format("{} (update {})", status.state_hash(), status.sequence()));
  line("occlusion", status.render().ao().has_enabled() && !status.render().ao().enabled() ? "off" : "on");
  line("pattern", pattern_text(status.render().pattern()));
  line("published", fmt::format("{} bytes", status.published_bytes()));
  line("refused messages", std::to_string(status.refused_messages()));
  line("last fault", status.last_fault().empty() ? "none" : status.last_fault());
  table += roi_text(status.roi());
  for (const std::string& warning : status.scene_warning()) table += fmt::format("warning: {}\n", printable(warning));
  table += choices_text(status);
  table += fmt::format("\n{:<16} {:<8} {:<8} {:>8}  {:<34}{}\n", "peer", "role", "state", "process", "state hash",
                       "modules");
  for (const proto::PeerStatus& peer : status.peer()) {
    table += fmt::format("{:<16} {:<8} {:<8} {:>8}  {:<34}{}\n", printable(peer.name()),
                         peer.role() == proto::DISPLAY ? "display"
                         : peer.spare()                ? "spare"
                                                       : "node",
                         printable(peer.state()), peer.process(), printable(peer.state_hash()),
                         module_ranges(std::vector<int>(peer.module().begin(), peer.module().end())));
  }
  table += fmt::format("\n{}", figures_of_peers(status));
  return table;
}

}  // namespace lfd
