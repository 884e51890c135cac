// Looking for numbers that are not finite.
#include "bench/stability/harmless.h"

#include <array>
#include <cmath>

#include "base/log.h"
#include "rendernode/geometry/depth_limits.h"
#include "rendernode/geometry/warp_table.h"
#include "rendernode/passes/gpu_colors.h"
#include "rendernode/passes/gpu_modules.h"

namespace lfd::bench {
namespace {

bool fits_float(double value) { return std::isfinite(static_cast<float>(value)); }

template <class Struct>
bool floats_are_finite(const Struct& params) {
  std::array<float, sizeof(Struct) / sizeof(float)> floats;
  std::memcpy(floats.data(), &params, sizeof(Struct));
  return std::ranges::all_of(floats, [](float f) { return std::isfinite(f); });
}

// Coordinates of any size.
constexpr std::array kPlaces{-1e30, -1e3, -0.6, -0.1, -1e-30, 0.0, 0.05, 0.3, 0.7, 2.0, 1e30};

std::string harm_of_maps(const DisplayCalibration& display, const ModuleCalibration& module) {
  for (int row = 0; row < display.image.height; row += std::max(1, display.image.height / 12)) {
    for (int column = 0; column < display.image.width; column += std::max(1, display.image.width / 12)) {
      const auto line = pixel_line(display, module, centre_of({column, row}));
      if (!line) continue;
      if (!is_finite(line->on_screen) || !is_finite(line->on_observer_line) || !(line->singular_depth < 0))
        return fmt::format("pixel {}, {} has a line that is not finite", column, row);
    }
  }
  for (const double x : kPlaces) {
    for (const double y : kPlaces) {
      for (const double z : kPlaces) {
        const auto p = image_from_physical(display, module, {x, y, z});
        if (p && !(std::isfinite(p->u) && std::isfinite(p->v) && std::isfinite(p->z)))
          return fmt::format("({}, {}, {}) has an image that is not finite", x, y, z);
      }
    }
  }
  return "";
}

std::string harm_of_color(const ColorCalibration& color, ImageSize image) {
  std::vector<float> samples;
  if (!floats_are_finite(color_params(color, samples)) ||
      !std::ranges::all_of(samples, [](float f) { return std::isfinite(f); })) {
    return "parameters of colour that are not finite";
  }
  for (const PixelPoint p : {PixelPoint{0, 0}, {0.3 * image.width, 0.6 * image.height}}) {
    for (const double light : {0.0, 1e-30, 0.2, 0.7, 1.0, 1e30}) {
      const glm::dvec3 drive = drive_for(color, gain_at(color.gain, image, p), {light, 0.5, 1 - light});
      const glm::dvec3 emitted = emitted_by(color, drive);
      for (int c = 0; c < 3; ++c) {
        if (!(drive[c] >= 0 && drive[c] <= 1)) return fmt::format("a drive of {}", drive[c]);
        if (!std::isfinite(emitted[c])) return fmt::format("an emitted light of {}", emitted[c]);
      }
    }
  }
  return "";
}

}  // namespace

std::string harm_of(const DisplayCalibration& display) {
  const DepthLimits limits = depth_limits(display, {});
  if (!(limits.back < limits.front) || !std::isfinite(limits.back) || !std::isfinite(limits.front) ||
      !(static_cast<float>(limits.depth_scale) > 0) || !fits_float(limits.depth_scale)) {
    return fmt::format("limits in z: {} to {}, scale {}", limits.back, limits.front, limits.depth_scale);
  }
  if (!(static_cast<float>(limits.back) < static_cast<float>(limits.front)))
    return fmt::format("limits in z: {} to {} are one float", limits.back, limits.front);
  for (const ModuleCalibration& module : display.modules) {
    if (auto harm = harm_of_maps(display, module); !harm.empty()) return harm;
    const bool is_grid = std::holds_alternative<GridMap>(module.map);
    const WarpTable table = is_grid ? warp_table(display, module, 4) : WarpTable{};
    if (!floats_are_finite(module_params(display, module, is_grid ? &table : nullptr, {})))
      return "parameters of the GPU that are not finite";
    for (const glm::vec2& residual : table.residual_px) {
      if (!std::isfinite(residual.x) || !std::isfinite(residual.y)) return "a warp table that is not finite";
    }
    if (module.color) {
      if (auto harm = harm_of_color(*module.color, display.image); !harm.empty()) return harm;
    }
    if (static_cast<double>(display.image.width) * display.image.height > 1e6) continue;
    for (const float place : pixel_table(display, module)) {
      if (!std::isfinite(place)) return "a pixel table that is not finite";
    }
  }
  return "";
}

std::string harm_of(const DisplayCalibration& display, const RegionOfInterest& roi, const RenderSettings& settings) {
  const auto to_physical = physical_from_world(roi);
  const auto to_world = world_from_physical(roi);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!fits_float(to_physical.linear[column][row]) || !fits_float(to_world.linear[column][row]))
        return "a map of the region of interest that float cannot hold";
    }
  }
  if (!(static_cast<float>(roi.diagonal_m() * roi.diagonal_m()) > 0) ||
      !fits_float(roi.diagonal_m() * roi.diagonal_m()))
    return "a diagonal whose square float cannot hold";
  const DepthLimits limits = depth_limits(display, settings);
  if (!(static_cast<float>(limits.back) < static_cast<float>(limits.front)))
    return fmt::format("limits in z: {} to {}", limits.back, limits.front);
  const double radius = settings.ao.radius_in_world_m(roi.diagonal_m());
  if (!(radius >= 0) || !fits_float(radius * radius)) return fmt::format("a radius of {} m", radius);
  return "";
}

Result<std::string> harm_of(const Deployment& deployment) {
  const ScreenSize screen = deployment.display.screen;
  LFD_TRY(const RegionOfInterest roi,
          complete_roi(deployment.message.roi(), {-1, -1, -1}, {1, 1, 1}, screen.width_m, screen.height_m));
  LFD_TRY_STATUS(check_radius(deployment.render.ao, roi));
  return harm_of(deployment.display, roi, deployment.render);
}

}  // namespace lfd::bench
