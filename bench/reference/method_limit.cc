// The methods, slowly.
#include "bench/reference/method_limit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <string_view>

#include "base/check.h"
#include "bench/reference/ao_limit.h"
#include "bench/reference/neighbourhood.h"

namespace lfd::reference {
namespace {

using std::numbers::pi;
using Vector = Neighbourhood::Vector;

template <class Sample>
double mean_of_samples(Neighbourhood& scene, Sample sample) {
  double sum = 0;
  for (int i = 0; i < scene.effort().samples; ++i) sum += sample();
  return sum / scene.effort().samples;
}

double sphere(Neighbourhood& scene) {
  return mean_of_samples(scene, [&] { return scene.hidden_by(scene.in_ball(scene.parameter("shell"))) ? 1.0 : 0.0; });
}

double crytek(Neighbourhood& scene) {
  return mean_of_samples(scene, [&] { return scene.hidden_by(scene.in_ball()) ? 1.0 : 0.0; });
}

double starcraft(Neighbourhood& scene) {
  return mean_of_samples(scene, [&] {
    Vector q = scene.in_ball();
    if (glm::dot(q, scene.normal()) < 0) q = -q;
    const auto distance = scene.hidden_by(q);
    return !distance ? 0.0 : *distance <= 1 ? 1.0 : 1 / *distance;
  });
}

double march(Neighbourhood& scene) {
  const glm::dmat3 frame = frame_about(scene.normal());
  const int steps = static_cast<int>(scene.parameter("steps"));
  return mean_of_samples(scene, [&] {
    const double sine2 = scene.uniform(), r = std::sqrt(sine2), phi = 2 * pi * scene.uniform(),
                 jitter = scene.uniform();
    const Vector direction = frame * Vector(r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - sine2));
    for (int j = 0; j < steps; ++j) {
      const double way = (j + jitter) / steps;
      const auto distance = scene.hidden_by(way * direction);
      if (distance && *distance <= scene.parameter("thickness")) return 1 - way;
    }
    return 0.0;
  });
}

struct DiskPoint {
  double x, y, r2;
};

DiskPoint in_disk(Neighbourhood& scene) {
  const double r2 = scene.uniform(), phi = 2 * pi * scene.uniform();
  return {std::sqrt(r2) * std::cos(phi), std::sqrt(r2) * std::sin(phi), r2};
}

// Of surfaces at most `farthest` radii away.
double obscurance(Neighbourhood& scene, double farthest) {
  const auto sample = [&] {
    const DiskPoint d = in_disk(scene);
    const auto v = scene.surface_at(scene.in_disk(d.x, d.y));
    if (!v || glm::length(*v) > farthest) return 0.0;
    return std::max(0.0, glm::dot(*v, scene.normal()) - scene.parameter("beta")) /
           (glm::dot(*v, *v) + scene.parameter("epsilon"));
  };
  return std::min(1.0, 2 * scene.parameter("sigma") * mean_of_samples(scene, sample));
}

double alchemy(Neighbourhood& scene) { return obscurance(scene, std::numeric_limits<double>::infinity()); }

// Its taps are as dense in every direction; rings outward are longer, so that they count more: over the disk it is
// alchemy, of what lies within the ball.
double scalable(Neighbourhood& scene) { return obscurance(scene, 1); }

// Along every direction the surface that hides most (Pyramid HBAO, equation 8), however many levels find it.
double pyramid_hbao(Neighbourhood& scene) {
  double sum = 0;
  for (int i = 0; i < scene.effort().directions; ++i) {
    const double angle = 2 * pi * (i + 0.5) / scene.effort().directions;
    double most = 0;
    for (int j = 0; j < scene.effort().steps; ++j) {
      const auto v =
          scene.surface_at((j + 0.5) / scene.effort().steps * scene.in_disk(std::cos(angle), std::sin(angle)));
      if (!v) continue;
      const double r = glm::length(*v);
      most = std::max(most, std::max(0.0, 1 - r) * glm::dot(scene.normal(), *v) / r);
    }
    sum += most;
  }
  return sum / scene.effort().directions;
}

double volumetric(Neighbourhood& scene) {
  double open = 0, whole = 0;
  for (int i = 0; i < scene.effort().samples / 2; ++i) {
    const DiskPoint d = in_disk(scene);
    const double half = std::sqrt(1 - d.r2);
    const auto share = [&](double side) -> std::optional<double> {
      const auto v = scene.surface_at(scene.in_disk(side * d.x, side * d.y));
      if (!v) return std::nullopt;
      const double value = (half - glm::dot(*v, scene.to_viewers())) / (2 * half);
      return value >= scene.parameter("least") && value <= scene.parameter("most") ? std::optional(value)
                                                                                   : std::nullopt;
    };
    const auto one = share(1), other = share(-1);
    open += half * (one && other ? *one + *other : 1);
    whole += 2 * half;
  }
  return 1 - open / whole;
}

double unreal(Neighbourhood& scene) {
  const auto angle = [&](const DiskPoint& d, double side) -> std::optional<double> {
    const auto v = scene.surface_at(scene.in_disk(side * d.x, side * d.y));
    if (!v || glm::dot(*v, scene.to_viewers()) > scene.parameter("range")) return std::nullopt;
    const Vector s = glm::normalize(*v);
    const double above = glm::dot(s, scene.normal());
    const Vector capped = above < 0 ? glm::normalize(s - above * scene.normal()) : s;
    return std::acos(std::clamp(glm::dot(scene.to_viewers(), capped) - scene.parameter("bias"), -1.0, 1.0));
  };
  return mean_of_samples(scene, [&] {
    const DiskPoint d = in_disk(scene);
    const auto one = angle(d, 1), other = angle(d, -1);
    return one && other ? 1 - std::min(*one + *other, pi) / pi : 0.0;
  });
}

double schmitt(Neighbourhood& scene) {
  return mean_of_samples(scene, [&] {
    const double r = std::max(scene.uniform(), 0.05), angle = 0.25 * pi * std::floor(8 * scene.uniform());
    const Vector q = scene.in_disk(r * std::cos(angle), r * std::sin(angle));
    const auto hit = scene.shown_at(q);
    if (!hit) return 0.0;
    const double difference = glm::dot(*scene.surface_at(q), scene.to_viewers()) / scene.parameter("range");
    const bool alike = glm::dot(to_glm(hit->shading_normal), scene.normal()) >= scene.parameter("parallel");
    return difference <= 0 || difference > 1 || alike ? 0.0 : 1 - difference;
  });
}

double hbao(Neighbourhood& scene) {
  double sum = 0;
  for (int i = 0; i < scene.effort().directions; ++i) {
    const double angle = 2 * pi * (i + 0.5) / scene.effort().directions;
    const Vector along = scene.in_disk(std::cos(angle), std::sin(angle));
    const double tangent = std::atan2(-glm::dot(scene.normal(), along), glm::dot(scene.normal(), scene.to_viewers()));
    double highest = std::sin(std::min(tangent + scene.parameter("bias"), pi / 2));
    for (int j = 0; j < scene.effort().steps; ++j) {
      const auto v = scene.surface_at((j + 0.5) / scene.effort().steps * along);
      if (!v || glm::length(*v) >= 1) continue;
      const double height = glm::dot(*v, scene.to_viewers()) / glm::length(*v);
      if (height > highest) {
        sum += (height - highest) * (1 - glm::dot(*v, *v));
        highest = height;
      }
    }
  }
  return std::min(1.0, sum / scene.effort().directions);
}

// Over one slice: angles from the viewers, positive along `along`; what is open is integrated by the midpoint rule with
// the weight cos(angle - gamma) |sin(angle)|.
double open_of_slice(Neighbourhood& scene, Vector along, double gamma, double& whole) {
  constexpr int kParts = 720;
  std::vector<char> hidden(kParts);
  const double low = gamma - pi / 2;
  const auto hide = [&](double from, double to) {
    for (int k = 0; k < kParts; ++k) {
      const double angle = low + pi * (k + 0.5) / kParts;
      if (angle >= from && angle <= to) hidden[static_cast<std::size_t>(k)] = 1;
    }
  };
  const bool bitmask = scene.parameter("bitmask") != 0;
  for (const double side : {1.0, -1.0}) {
    const double edge = side > 0 ? gamma + pi / 2 : gamma - pi / 2;
    double highest = std::cos(edge);
    for (int j = 0; j < scene.effort().steps; ++j) {
      const auto v = scene.surface_at(side * (j + 0.5) / scene.effort().steps * along);
      if (!v || glm::length(*v) > 1) continue;
      const auto angle_of = [&](Vector w) {
        return side * std::acos(std::clamp(glm::dot(w, scene.to_viewers()) / glm::length(w), -1.0, 1.0));
      };
      if (bitmask) {
        const double a = angle_of(*v), b = angle_of(*v - scene.parameter("thickness") * scene.to_viewers());
        hide(std::min(a, b), std::max(a, b));
      } else {
        const double weight = std::clamp((1 - glm::length(*v)) / scene.parameter("falloff"), 0.0, 1.0);
        highest = std::max(highest, std::cos(edge) + weight * (std::cos(angle_of(*v)) - std::cos(edge)));
      }
    }
    const double horizon = side * std::acos(std::clamp(highest, -1.0, 1.0));
    if (!bitmask) hide(std::min(horizon, edge), std::max(horizon, edge));
  }
  double open = 0;
  for (int k = 0; k < kParts; ++k) {
    const double angle = low + pi * (k + 0.5) / kParts, weight = std::cos(angle - gamma) * std::abs(std::sin(angle));
    whole += weight;
    if (!hidden[static_cast<std::size_t>(k)]) open += weight;
  }
  return open;
}

double gtao(Neighbourhood& scene) {
  double open = 0, whole = 0;
  const int slices = scene.effort().directions / 2;
  for (int i = 0; i < slices; ++i) {
    const double angle = pi * (i + 0.5) / slices;
    const Vector along = scene.in_disk(std::cos(angle), std::sin(angle));
    const double x = glm::dot(scene.normal(), along), y = glm::dot(scene.normal(), scene.to_viewers());
    double of_slice = 0;
    open += std::hypot(x, y) * open_of_slice(scene, along, std::atan2(x, y), of_slice);
    whole += std::hypot(x, y) * of_slice;
  }
  return 1 - open / whole;
}

}  // namespace

Spot spot_of(const ModuleView& view, const WorldScene& scene, const Hit& hit) {
  const auto shown = on_screen(view.display.optics, view.module.emitter, hit.physical);
  const auto line = shown ? line_of_screen_point(view.display.optics, view.module.emitter, shown->at) : std::nullopt;
  LFD_CHECK(line.has_value(), "what a pixel shows has a line");
  const Vector3<World> along =
      scene.world_from_physical * line->on_observer_line - scene.world_from_physical * line->on_screen;
  const bool is_front = glm::dot(to_glm(hit.geometric_normal), to_glm(along)) >= 0;
  const Vector3<World>& n = hit.shading_normal;
  return {hit.world, is_front ? n : Vector3<World>{-n.x, -n.y, -n.z}};
}

double method_limit(const Intersector& intersector, const ModuleView& view, const Spot& spot,
                    const AoSettings& settings, double radius_m, const LimitEffort& effort) {
  static const std::map<std::string_view, double (*)(Neighbourhood&)> kMethods{
      {"alchemy", alchemy},     {"crytek", crytek},   {"gtao", gtao},
      {"hbao", hbao},           {"march", march},     {"pyramid_hbao", pyramid_hbao},
      {"scalable", scalable},   {"schmitt", schmitt}, {"sphere", sphere},
      {"starcraft", starcraft}, {"unreal", unreal},   {"volumetric", volumetric}};
  const auto known = kMethods.find(settings.method->name);
  LFD_CHECK(known != kMethods.end(), "every method has a limit");
  Neighbourhood scene(intersector, view, spot, settings, radius_m, effort);
  return known->second(scene);
}

double curved_limit(const Intersector& intersector, const ModuleView& view, const Spot& spot,
                    const AoSettings& settings, const LimitEffort& effort) {
  double radius_m = settings.radius_in_world_m(intersector.scene().roi_diagonal_m), most = 0;
  for (int i = 0; i < settings.radii; ++i, radius_m /= 2)
    most = std::max(most, method_limit(intersector, view, spot, settings, radius_m, effort));
  return post_curve(most, settings);
}

}  // namespace lfd::reference
