// Checks and equations of colour calibrations.
#include "calibration/color.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "base/log.h"
#include "base/srgb.h"

namespace lfd {
namespace {

constexpr std::array kChannels{"red", "green", "blue"};
constexpr double kMinGamma = 0.1, kMaxGamma = 10;
constexpr double kMaxEntry = 1e3;      // of the matrix
constexpr double kMaxCondition = 1e4;  // of the matrix, by its Frobenius norm

Status validate(const GainMap& map) {
  for (const auto& [name, value] : {std::pair{"columns", map.columns}, std::pair{"rows", map.rows}}) {
    if (value < 1 || value > kMaxGainSide)
      return Error(fmt::format("{}: {}; 1 to {} are possible", name, value, kMaxGainSide));
  }
  const std::size_t expected = static_cast<std::size_t>(map.columns) * map.rows;
  if (map.node.size() != expected) {
    return Error(
        fmt::format("r: {} numbers; {} columns x {} rows are {}", map.node.size(), map.columns, map.rows, expected));
  }
  for (std::size_t i = 0; i < map.node.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      if (map.node[i][c] >= 0 && map.node[i][c] <= kMaxGain) continue;
      return Error(fmt::format("{} {}: {} must be between 0 and {}", "rgb"[c], i, map.node[i][c], kMaxGain));
    }
  }
  return {};
}

Status validate(const SrgbCurve&) { return {}; }

Status validate(const GammaCurve& curve) {
  if (curve.gamma >= kMinGamma && curve.gamma <= kMaxGamma) return {};
  return Error(fmt::format("gamma: {} must be between {} and {}", curve.gamma, kMinGamma, kMaxGamma));
}

Status validate(const TableCurve& curve) {
  const std::size_t count = curve.drive.size();
  if (count < 2 || count > kMaxCurveSamples)
    return Error(fmt::format("drive: {} samples; 2 to {} are possible", count, kMaxCurveSamples));
  for (std::size_t i = 0; i < count; ++i) {
    const double drive = curve.drive[i];
    if (!(drive >= 0 && drive <= 1)) return Error(fmt::format("drive {}: {} must be between 0 and 1", i, drive));
    if (i > 0 && drive < curve.drive[i - 1])
      return Error(fmt::format("drive {}: {} falls below the sample before it, {}", i, drive, curve.drive[i - 1]));
  }
  if (curve.drive.front() == curve.drive.back())
    return Error(fmt::format("drive: all samples are {}", curve.drive.front()));
  return {};
}

double frobenius(const glm::dmat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

Status validate_matrix(const glm::dmat3& m) {
  for (int i = 0; i < 9; ++i) {
    if (!(std::abs(m[i % 3][i / 3]) <= kMaxEntry))
      return Error(fmt::format("device_from_display {}: {} must be between -{} and {}", i, m[i % 3][i / 3], kMaxEntry,
                               kMaxEntry));
  }
  const double condition = frobenius(m) * frobenius(glm::inverse(m)) / 3;
  if (condition <= kMaxCondition) return {};
  if (!std::isfinite(condition)) return Error("device_from_display: is singular");
  return Error(
      fmt::format("device_from_display: is singular or nearly so: condition number {:.3g}; at most {} is possible",
                  condition, kMaxCondition));
}

double drive_of(const SrgbCurve&, double light) { return srgb_from_linear(light); }
double drive_of(const GammaCurve& curve, double light) { return std::pow(light, 1 / curve.gamma); }
double drive_of(const TableCurve& curve, double light) {
  const double place = light * static_cast<double>(curve.drive.size() - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(place), curve.drive.size() - 2);
  return std::lerp(curve.drive[first], curve.drive[first + 1], place - static_cast<double>(first));
}

double light_of(const SrgbCurve&, double drive) { return linear_from_srgb(drive); }
double light_of(const GammaCurve& curve, double drive) { return std::pow(drive, curve.gamma); }
double light_of(const TableCurve& curve, double drive) {
  const auto& table = curve.drive;
  if (drive <= table.front()) return 0;
  if (drive > table.back()) return 1;
  const auto above = std::ranges::lower_bound(table, drive);  // its sample reaches the drive, the one before does not
  const double before = *(above - 1);
  const double place = static_cast<double>(above - table.begin() - 1) + (drive - before) / (*above - before);
  return place / static_cast<double>(table.size() - 1);
}

}  // namespace

Status validate(const ColorCalibration& color) {
  if (auto status = validate(color.gain); !status) return status.error().within("gain");
  for (int c = 0; c < 3; ++c) {
    const double black = color.black_level[c];
    if (!(black >= 0 && black < 1))
      return Error(fmt::format("black_level {}: {} must be at least 0 and less than 1", c, black));
  }
  LFD_TRY_STATUS(validate_matrix(color.device_from_display));
  for (std::size_t c = 0; c < 3; ++c) {
    const auto status = std::visit([](const auto& curve) { return validate(curve); }, color.curve[c]);
    if (!status) return status.error().within(kChannels[c]);
  }
  return {};
}

glm::dvec3 gain_at(const GainMap& map, ImageSize image, PixelPoint p) {
  const double u = std::clamp(p.x / image.width, 0.0, 1.0) * (map.columns - 1);
  const double v = std::clamp(p.y / image.height, 0.0, 1.0) * (map.rows - 1);
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  const int right = std::min(left + 1, map.columns - 1), bottom = std::min(top + 1, map.rows - 1);
  const auto node = [&map](int column, int row) {
    return map.node[static_cast<std::size_t>(row * map.columns + column)];
  };
  const glm::dvec3 upper = glm::mix(node(left, top), node(right, top), u - left);
  const glm::dvec3 lower = glm::mix(node(left, bottom), node(right, bottom), u - left);
  return glm::mix(upper, lower, v - top);
}

double drive_from_light(const TransferCurve& curve, double light) {
  return std::visit([light](const auto& one) { return drive_of(one, light); }, curve);
}

double light_from_drive(const TransferCurve& curve, double drive) {
  return std::visit([drive](const auto& one) { return light_of(one, drive); }, curve);
}

glm::dvec3 drive_for(const ColorCalibration& color, glm::dvec3 gain, glm::dvec3 light) {
  const glm::dvec3 shown = gain * glm::clamp(light, 0.0, 1.0) - color.black_level;
  const glm::dvec3 device = glm::clamp(color.device_from_display * shown, 0.0, 1.0);
  glm::dvec3 drive;
  for (int c = 0; c < 3; ++c) drive[c] = drive_from_light(color.curve[static_cast<std::size_t>(c)], device[c]);
  return drive;
}

glm::dvec3 emitted_by(const ColorCalibration& color, glm::dvec3 drive) {
  glm::dvec3 device;
  for (int c = 0; c < 3; ++c) device[c] = light_from_drive(color.curve[static_cast<std::size_t>(c)], drive[c]);
  return color.black_level + glm::inverse(color.device_from_display) * device;
}

}  // namespace lfd
