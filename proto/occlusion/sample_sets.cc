// The four generators, and shells, disks and lobes made of them.
#include "proto/occlusion/sample_sets.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <numeric>
#include <random>

namespace lfd::occlusion {
namespace {

// Uniform numbers in [0, 1) from the generator's raw bits: the library's distributions differ between platforms.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double next() { return engine_() * (1.0 / 4294967296.0); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() * static_cast<double>(n)); }

 private:
  std::mt19937 engine_;
};

double signed_unit(double u) { return 2 * u - 1; }

std::vector<glm::dvec2> uniform_points(int count, Random& random) {
  std::vector<glm::dvec2> points;
  for (int i = 0; i < count; ++i) {
    const double x1 = signed_unit(random.next());
    points.push_back({x1, signed_unit(random.next())});
  }
  return points;
}

// One point in each cell of the most nearly square grid of `count` cells.
std::vector<glm::dvec2> jittered_points(int count, Random& random) {
  int rows = static_cast<int>(std::sqrt(static_cast<double>(count)));
  while (count % rows != 0) --rows;
  const int columns = count / rows;
  std::vector<glm::dvec2> points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x1 = signed_unit((row + random.next()) / rows);
      points.push_back({x1, signed_unit((column + random.next()) / columns)});
    }
  }
  return points;
}

// One point in each row and each column of a count x count grid.
std::vector<glm::dvec2> latin_points(int count, Random& random) {
  std::vector<int> column(static_cast<std::size_t>(count));
  std::iota(column.begin(), column.end(), 0);
  for (std::size_t i = column.size(); i > 1; --i) std::swap(column[i - 1], column[random.below(i)]);
  std::vector<glm::dvec2> points;
  for (int row = 0; row < count; ++row) {
    const double x1 = signed_unit((row + random.next()) / count);
    points.push_back({x1, signed_unit((column[static_cast<std::size_t>(row)] + random.next()) / count)});
  }
  return points;
}

double wrapped_distance2(glm::dvec2 a, glm::dvec2 b) {
  const double dx = a.x - b.x;
  double dy = std::abs(a.y - b.y);
  dy = std::min(dy, 2 - dy);
  return dx * dx + dy * dy;
}

// Dart throwing with a radius that shrinks until exactly `count` points fit (x2 wraps around).
std::vector<glm::dvec2> poisson_points(int count, Random& random) {
  std::vector<glm::dvec2> points;
  double radius = std::sqrt(4.0 / count);
  while (static_cast<int>(points.size()) < count) {
    bool placed = false;
    for (int attempt = 0; attempt < 64 && !placed; ++attempt) {
      const double x1 = signed_unit(random.next());
      const glm::dvec2 candidate{x1, signed_unit(random.next())};
      placed =
          std::ranges::all_of(points, [&](glm::dvec2 p) { return wrapped_distance2(p, candidate) >= radius * radius; });
      if (placed) points.push_back(candidate);
    }
    if (!placed) radius *= 0.95;
  }
  return points;
}

glm::dvec3 on_sphere(glm::dvec2 x) {  // Algorithm 3
  const double phi = std::numbers::pi * x.y, r = std::sqrt(std::max(0.0, 1 - x.x * x.x));
  return {r * std::cos(phi), r * std::sin(phi), x.x};
}

// A second stream of numbers beside the square's, for what each sample needs once more.
Random beside(const SampleChoice& choice) { return Random(choice.seed ^ 0x9e3779b9U); }

// Farthest-point order of points of the square; the first stays the first.
std::vector<std::size_t> farthest_first(const std::vector<glm::dvec2>& points) {
  std::vector<double> nearest2(points.size(), 8);  // to what is chosen; more than any distance in the square
  std::vector<std::size_t> order;
  for (std::size_t next = 0; order.size() < points.size();) {
    order.push_back(next);
    for (std::size_t i = 0; i < points.size(); ++i)
      nearest2[i] = i == next ? -1 : std::min(nearest2[i], wrapped_distance2(points[i], points[next]));
    next = static_cast<std::size_t>(std::ranges::max_element(nearest2) - nearest2.begin());
  }
  return order;
}

bool is_in_pairs(const std::vector<glm::vec4>& samples) {
  return samples.size() > 1 && glm::vec3(samples[0]) == -glm::vec3(samples[1]);
}

// Half as many points where the other half mirrors them.
std::vector<glm::dvec2> half_or_all(SampleChoice choice, bool pairs) {
  if (pairs) choice.count = (choice.count + 1) / 2;
  return square_points(choice);
}

}  // namespace

std::vector<glm::dvec2> square_points(const SampleChoice& choice) {
  Random random(choice.seed);
  switch (choice.generator) {
    case SampleGenerator::kUniform:
      return uniform_points(choice.count, random);
    case SampleGenerator::kJittered:
      return jittered_points(choice.count, random);
    case SampleGenerator::kLatinSquare:
      return latin_points(choice.count, random);
    case SampleGenerator::kPoissonDisk:
      return poisson_points(choice.count, random);
  }
  return {};
}

std::vector<glm::vec4> shell_set(const SampleChoice& choice, double inner, bool pairs) {
  Random random = beside(choice);
  const double inner3 = std::pow(inner, 3);
  std::vector<glm::vec4> samples;
  for (const auto& x : half_or_all(choice, pairs)) {
    const double radius = std::cbrt(inner3 + (1 - inner3) * random.next());  // Algorithm 4
    const glm::dvec3 p = radius * on_sphere(x);
    samples.emplace_back(p.x, p.y, p.z, 0);
    if (pairs && static_cast<int>(samples.size()) < choice.count) samples.emplace_back(-p.x, -p.y, -p.z, 0);
  }
  return samples;
}

std::vector<glm::vec4> disk_set(const SampleChoice& choice, bool pairs) {
  std::vector<glm::vec4> samples;
  for (const auto& x : half_or_all(choice, pairs)) {
    const double r = std::sqrt(0.5 * (x.x + 1)), phi = std::numbers::pi * x.y;
    samples.emplace_back(r * std::cos(phi), r * std::sin(phi), 0, r);
    if (pairs && static_cast<int>(samples.size()) < choice.count) {
      const glm::vec4 p = samples.back();
      samples.emplace_back(-p.x, -p.y, 0, p.w);
    }
  }
  return samples;
}

std::vector<glm::vec4> cosine_set(const SampleChoice& choice) {
  Random random = beside(choice);
  std::vector<glm::vec4> samples;
  for (const auto& x : square_points(choice)) {
    const double sine2 = 0.5 * (x.x + 1), r = std::sqrt(sine2), phi = std::numbers::pi * x.y;
    samples.emplace_back(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - sine2), random.next());
  }
  return samples;
}

void spread_prefixes(std::vector<glm::vec4>& samples, const SampleChoice& choice) {
  const bool pairs = is_in_pairs(samples);
  const std::size_t together = pairs ? 2 : 1;
  std::vector<glm::dvec2> points = half_or_all(choice, pairs);
  points.resize(samples.size() / together);  // one without a partner stays the last
  const std::vector<glm::vec4> made = samples;
  auto to = samples.begin();
  for (const std::size_t i : farthest_first(points))
    to = std::copy_n(made.begin() + static_cast<std::ptrdiff_t>(together * i), together, to);
}

}  // namespace lfd::occlusion
