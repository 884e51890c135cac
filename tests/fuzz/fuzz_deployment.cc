// Fuzz target: deployments are refused with a reason that names the file, or written and read again they are equal.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/check.h"
#include "calibration/make.h"
#include "proto/deployment_file.h"
#include "proto/state.h"
#include "proto/text_file.h"

namespace {

bool same(const lfd::Deployment& a, const lfd::Deployment& b) {
  if (!lfd::same_message(a.message, b.message) || a.scene_file != b.scene_file || a.nodes.size() != b.nodes.size())
    return false;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    if (a.nodes[i].name != b.nodes[i].name || a.nodes[i].modules != b.nodes[i].modules) return false;
  }
  return a.render == b.render && a.pacing.heartbeat == b.pacing.heartbeat && a.addresses.control == b.addresses.control;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const lfd::DisplayCalibration kDisplay = *lfd::make_display("desk");
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto deployment = lfd::parse_deployment(text, "f", kDisplay);
  if (!deployment) {
    LFD_CHECK(deployment.error().message().starts_with("f"), "every refusal names the file");
    return 0;
  }
  const std::size_t modules = kDisplay.modules.size();
  std::size_t owned = 0;
  for (const lfd::NodeShare& node : deployment->nodes) owned += node.modules.size();
  LFD_CHECK(owned + lfd::unowned_modules(*deployment).size() == modules, "each module has one node, or none");
  const auto copy = lfd::parse_deployment(lfd::print_text(deployment->message), "g", kDisplay);
  LFD_CHECK(copy && same(*deployment, *copy), "the same deployment comes back");
  return 0;
}
