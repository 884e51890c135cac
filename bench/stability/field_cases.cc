// Bad numbers in every field of calibrations and deployments: refused by name, or harmless.
#include <set>

#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "bench/stability/groups.h"
#include "bench/stability/harmless.h"
#include "bench/stability/message_fields.h"
#include "bench/stability/spoilt_displays.h"
#include "bench/stability/tally.h"
#include "proto/calibration_file.h"
#include "proto/deployment_file.h"
#include "proto/text_file.h"

namespace lfd::bench {
namespace {

constexpr const char* kCalibrationFile = "display.textproto";

// How every error about a field begins: file, line of the field (a field of the file's own may be absent, for its 0
// is), and module.
std::string beginning_of(const std::string& road) {
  const std::size_t colon = road.find(':');
  if (colon == road.npos) return fmt::format("{}:", kCalibrationFile);
  const std::string module = road.starts_with("module") ? road.substr(0, colon + 2) : "";
  return fmt::format("{}:#: {}", kCalibrationFile, module);
}

StabilityCase calibration_case(const std::string& kind, const NumberField& field) {
  return {"fields of calibrations", kind + ": " + field.road, kEachRefusedOrHarmless, [field](const gl::Context&) {
            Tally tally(field.words, beginning_of(field.road));
            for (const auto& [value, message] : field.spoilt) {
              proto::DisplayCalibration read;
              const auto places = parse_text(print_text(*message), kCalibrationFile, read);
              if (!places) {
                tally.refused(value, places.error().message());
                continue;
              }
              const auto display = read_calibration(read);
              display ? tally.accepted(value, harm_of(*display))
                      : tally.refused(value, places->locate(display.error()).message());
            }
            return tally.outcome();
          }};
}

// A deployment with every field that has a number, but those that would change nothing.
proto::Deployment whole_deployment() {
  proto::Deployment m;
  m.set_display("display.textproto");
  m.mutable_scene()->mutable_made()->set_name("room");
  m.mutable_scene()->set_frames_per_second(30);
  auto& roi = *m.mutable_roi();
  for (auto* vector : {roi.mutable_world_centre(), roi.mutable_world_size(), roi.mutable_physical_centre(),
                       roi.mutable_physical_size()}) {
    vector->set_x(0.4);
    vector->set_y(0.3);
    vector->set_z(0.2);
  }
  roi.mutable_world_orientation()->set_w(0.6);
  roi.mutable_world_orientation()->set_y(0.8);
  auto& render = *m.mutable_render();
  render.mutable_background()->set_r(0.5);
  render.set_near_z_m(0.5);
  render.set_far_z_m(-0.4);
  render.mutable_ao()->mutable_curve()->set_a(0.5);
  render.mutable_ao()->mutable_curve()->set_b(1);
  render.mutable_ao()->mutable_curve()->set_c(1);
  render.mutable_ao()->mutable_blur()->set_sigma_px(1.5);
  m.add_node()->set_name("only");
  m.mutable_pacing()->set_deadline_ms(100);
  return m;
}

StabilityCase deployment_case(const NumberField& field) {
  return {"fields of deployments", field.road, kEachRefusedOrHarmless, [field](const gl::Context&) {
            const auto folder = TemporaryFolder::make("lfd-stability");
            if (!folder) return Outcome{folder.error().message(), 0, false};
            const std::string file = folder->path() / "deployment.textproto";
            Tally tally(field.words, file + ":");
            const Status saved = save_calibration(folder->path() / "display.textproto", plain_display());
            if (!saved) return Outcome{saved.error().message(), 0, false};
            for (const auto& [value, message] : field.spoilt) {
              const Status written = write_file(folder->path() / "deployment.textproto", print_text(*message));
              if (!written) return Outcome{written.error().message(), 0, false};
              const auto deployment = load_deployment(folder->path() / "deployment.textproto");
              if (!deployment) {
                tally.refused(value, deployment.error().message());
                continue;
              }
              // What only the scene's bounds show to be wrong is said when it is shown, without the file.
              const auto harm = harm_of(*deployment);
              harm ? tally.accepted(value, *harm) : tally.refused(value, file + ": " + harm.error().message());
            }
            return tally.outcome();
          }};
}

}  // namespace

void add_field_cases(StabilityCases& cases) {
  // A number of the first module, of the optics or of the screen means something else on every kind of display; further
  // modules are read like the first.
  std::set<std::string> seen;
  for (const auto& [kind, display] : spoilable_displays()) {
    for (const NumberField& field : number_fields(write_calibration(display))) {
      const bool is_again = !seen.insert(field.road).second && field.road.starts_with("module 1");
      if (!is_again) cases.push_back(calibration_case(kind, field));
    }
  }
  for (const NumberField& field : number_fields(whole_deployment())) cases.push_back(deployment_case(field));
}

}  // namespace lfd::bench
