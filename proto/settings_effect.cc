// Settings that change nothing.
#include "proto/settings_effect.h"

#include "base/check.h"
#include "base/log.h"
#include "proto/settings.h"

namespace lfd {

std::vector<std::string> without_effect(const proto::RenderSettings& message) {
  const auto settings = read_settings(message);
  LFD_CHECK(settings, "only settings that can be read have effects");
  const AoSettings& ao = settings->ao;
  const proto::AmbientOcclusion& said = message.ao();
  std::vector<std::string> lines;
  if (!ao.enabled) return lines;
  if (said.radius_m() > 0 && said.radius_roi() > 0)
    lines.emplace_back("ao.radius_roi: has no effect beside ao.radius_m");
  if (said.samples() > 0 && ao.method->samples == 0 && !ao.is_chosen_by_budget())
    lines.push_back(fmt::format("ao.samples: has no effect: {} takes none", ao.method->name));
  if (said.samples() > 0 && ao.is_chosen_by_budget())
    lines.emplace_back("ao.samples: has no effect: with a budget every node chooses them");
  const bool gaussian = ao.blur == AoBlur::kGaussian;
  if (said.blur().sigma_px() != 0 && !gaussian)
    lines.emplace_back("ao.blur.sigma_px: has no effect: the blur weighs by geometry");
  if (said.blur().taps() > 0 && gaussian) lines.emplace_back("ao.blur.taps: has no effect: the blur is Gaussian");
  return lines;
}

}  // namespace lfd
