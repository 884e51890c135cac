// What settings, planner and passes know of a method of ambient occlusion; its arithmetic is shaders/ao/NAME.frag.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace lfd {

enum class SampleGenerator { kPoissonDisk, kUniform, kJittered, kLatinSquare };

}  // namespace lfd

namespace lfd::occlusion {

// One number that a method can be told.
struct Parameter {
  std::string_view name;
  double fallback, least, most;
  std::string_view meaning;  // with its unit
  bool is_whole = false;
};

// ao' = 1 - clamp(b ((1 - ao) + a), 0, 1)^c
struct Curve {
  double a, b, c;
  bool operator==(const Curve&) const = default;
};

struct SampleChoice {
  SampleGenerator generator = SampleGenerator::kPoissonDisk;
  int count = 8;
  std::uint32_t seed = 0;
};

// The set that every pixel turns for itself; `parameters` are the method's, in its order.
using SampleSet = std::vector<glm::vec4> (*)(const SampleChoice& choice, std::span<const double> parameters);

// A pyramid of positions, each level so many times smaller than the one before; the parameter `levels` says how many
// are made, the full picture counted.
enum class Pyramid {
  kNone,
  kPicked,    // 2 x 2: one of the pixels
  kAveraged,  // 3 x 3: their mean
};
inline constexpr int kMostPyramidLevels = 5;

struct Method {
  std::string_view name;
  std::string_view source;                // paper, and equation or algorithm
  std::span<const Parameter> parameters;  // in the order of the shader's uniform block `Parameters`, floats one by one
  Curve curve;                            // unless the settings have one
  int samples = 0;                        // per radius unless the settings say; 0: it takes none
  bool pairs = false;                     // samples come in pairs: an odd number is refused
  bool normal = false;                    // reads the surface's normal
  bool directions = false;                // knows which directions are open: bent normals are possible
  bool points = false;                    // asks whether points are hidden: neighbours can answer too
  Pyramid pyramid = Pyramid::kNone;       // reads it
  SampleSet sample_set = nullptr;         // null: it takes none, or makes its own
};

// All there are, in the order of their names.
std::span<const Method* const> methods();

// sphere
const Method& default_method();

// Null where there is none of that name.
const Method* find_method(std::string_view name);

// What the parameters are where nothing is said.
std::vector<double> fallbacks(const Method& method);

}  // namespace lfd::occlusion
