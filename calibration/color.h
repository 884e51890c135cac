// What a module makes of the numbers it is fed, and how it is fed so that it shows the light that is meant.
//
// All light is linear, r g b of the display, 1 the brightest that a module without a colour calibration shows. To show
// the light c at a pixel, the module is fed per channel
//   drive = curve(clamp(M (g clamp(c, 0, 1) - B), 0, 1))
//     g      gain at the pixel (r g b): the share of the light that is left to this module, for blending, or for its
//            dimmer corners' sake
//     B      black level (r g b): what the module emits when it is fed 0
//     M      device_from_display (3x3): shares of full red, green and blue of the device that make the light
//     curve  the transfer curve of the channel: drive, 0 to 1 (a byte is 255 of it), for a share of the full light
// Fed with a drive, it emits, in the same light,
//   emitted = B + M^-1 curve^-1(drive)
// which is g c wherever no clamp took effect. Nothing is raised to hide a black level: what is darker than B is shown
// as B. Where the gain is g the viewer is meant to see emitted / g.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "base/result.h"
#include "calibration/spaces/pixel.h"

namespace lfd {

// Gains at nodes at even distances over the image, the outermost on its border; rows from the top, columns from the
// left; bilinear between them. Along a side with one node the gain does not change.
struct GainMap {
  int columns = 1, rows = 1;
  std::vector<glm::dvec3> node{glm::dvec3(1)};  // columns x rows
  bool operator==(const GainMap&) const = default;
};

// drive = sRGB of the light.
struct SrgbCurve {
  bool operator==(const SrgbCurve&) const = default;
};

// drive = light^(1 / gamma).
struct GammaCurve {
  double gamma = 2.2;
  bool operator==(const GammaCurve&) const = default;
};

// Drives for even steps of light from 0 to 1, linear between them. They never fall, and the last is above the first.
struct TableCurve {
  std::vector<double> drive;
  bool operator==(const TableCurve&) const = default;
};

using TransferCurve = std::variant<SrgbCurve, GammaCurve, TableCurve>;

struct ColorCalibration {
  GainMap gain;
  glm::dvec3 black_level{0};
  glm::dmat3 device_from_display{1};
  std::array<TransferCurve, 3> curve;  // red, green, blue
  bool operator==(const ColorCalibration&) const = default;
};

// Limits of what is accepted. With them the numbers of all modules of a node fit into a buffer that every GPU has.
inline constexpr int kMaxGainSide = 128;
inline constexpr int kMaxCurveSamples = 4096;
inline constexpr double kMaxGain = 100;

// Errors begin with the field ("gain: g 12: ...", "red: gamma: ...", "device_from_display: ...").
Status validate(const ColorCalibration& color);

glm::dvec3 gain_at(const GainMap& map, ImageSize image, PixelPoint p);

// Of light and drive from 0 to 1.
double drive_from_light(const TransferCurve& curve, double light);

// The least light that has the drive; 0 below the curve's first drive, 1 above its last.
double light_from_drive(const TransferCurve& curve, double drive);

// The equations above; all numbers are finite.
glm::dvec3 drive_for(const ColorCalibration& color, glm::dvec3 gain, glm::dvec3 light);
glm::dvec3 emitted_by(const ColorCalibration& color, glm::dvec3 drive);

}  // namespace lfd
