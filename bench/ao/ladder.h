// The settings of every method of ambient occlusion that are compared: from a few samples to more than anybody would
// pay for.
#pragma once

#include <string>
#include <vector>

#include "proto/settings.h"

namespace lfd::bench {

// Where a rung is drawn.
enum class RungUse {
  kEverywhere,  // every scene, module and radius
  kStudy,       // the middle module and the middle radius of every scene: blurs, options, sharing
};

// One setting of one method. Radius, and curve where the settings have none, are those of the place and the method.
struct Rung {
  std::string name;    // of its method: "8 directions, 10 steps"
  std::string origin;  // "Pyramid HBAO, table 1a"; empty: this driver's own
  RungUse use = RungUse::kEverywhere;
  bool is_default = false;  // what a deployment gets that names the method only
  proto::AmbientOcclusion settings;

  std::string method() const { return settings.method(); }
};

// All of them, method by method; `methods` empty: of all methods. Among them are those of the
// tables of Pyramid HBAO (2021) and the performance and quality set-ups of Aalund (2013, tables 2 to 4).
std::vector<Rung> ladder(const std::vector<std::string>& methods);

// What a pixel costs at most, of all radii, by the passes up to where occlusion is known; of half the resolution a
// quarter counts.
struct TapCount {
  double samples = 0;  // points, or places in the picture, that are looked at
  double fetches = 0;  // texels, the pixel's own among them
};
TapCount taps_of(const AoSettings& settings);

// Name of a blur as tables have it: "none", "gaussian 1.5 px", "geometry 2 taps".
std::string blur_name(const AoSettings& settings);

}  // namespace lfd::bench
