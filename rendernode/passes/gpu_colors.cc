// Colour parameters and their samples.
#include "rendernode/passes/gpu_colors.h"

#include <algorithm>

namespace lfd {
namespace {

using glm::vec4;

// Where samples begin is said in floats, which count exactly so far.
static_assert(MODULES_PER_NODE * 3 * (kMaxGainSide * kMaxGainSide + kMaxCurveSamples) <= 1 << 24);

vec4 row_of(const glm::dmat3& m, int row, double w) { return {m[0][row], m[1][row], m[2][row], w}; }

vec4 curve_params(const TransferCurve& curve, std::vector<float>& samples) {
  if (const auto* gamma = std::get_if<GammaCurve>(&curve)) return {1, 1 / gamma->gamma, 0, 0};
  const auto* table = std::get_if<TableCurve>(&curve);
  if (table == nullptr) return {0, 0, 0, 0};
  const vec4 params{2, samples.size(), table->drive.size(), 0};
  samples.insert(samples.end(), table->drive.begin(), table->drive.end());
  return params;
}

}  // namespace

shared::ColorParams color_params(const ColorCalibration& color, std::vector<float>& samples) {
  shared::ColorParams params{};
  params.device_from_display_0 = row_of(color.device_from_display, 0, 1);
  params.device_from_display_1 = row_of(color.device_from_display, 1, 0);
  params.device_from_display_2 = row_of(color.device_from_display, 2, 0);
  params.black_level = vec4(color.black_level, 0);
  params.gain = {color.gain.columns, color.gain.rows, samples.size(), 0};
  for (const glm::dvec3& node : color.gain.node) {
    for (int c = 0; c < 3; ++c) samples.push_back(static_cast<float>(node[c]));
  }
  params.curve_0 = curve_params(color.curve[0], samples);
  params.curve_1 = curve_params(color.curve[1], samples);
  params.curve_2 = curve_params(color.curve[2], samples);
  return params;
}

std::optional<GpuColors> upload_colors(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules) {
  if (std::ranges::none_of(modules, [&](auto module) { return display.modules[module].color.has_value(); }))
    return std::nullopt;
  std::vector<shared::ColorParams> params(MODULES_PER_NODE);
  std::vector<float> samples;
  for (std::size_t layer = 0; layer < modules.size(); ++layer) {
    const auto& color = display.modules[modules[layer]].color;
    if (color) params[layer] = color_params(*color, samples);
  }
  return GpuColors{gl::make_buffer(params), gl::make_buffer(samples)};
}

}  // namespace lfd
