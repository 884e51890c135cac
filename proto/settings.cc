// Settings out of messages, with defaults and limits.
#include "proto/settings.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/log.h"
#include "base/suggest.h"
#include "proto/check_range.h"
#include "proto/occlusion/sample_sets.h"

namespace lfd {
namespace {

template <class S>
Point3<S> point_from(const proto::Vector& v) {
  return {v.x(), v.y(), v.z()};
}

template <class V>
void set_vector(proto::Vector* to, const V& from) {
  to->set_x(from.x);
  to->set_y(from.y);
  to->set_z(from.z);
}

glm::dvec3 size_from(const proto::Vector& v) { return {v.x(), v.y(), v.z()}; }

std::string parameter_names(const occlusion::Method& method) {
  std::vector<std::string_view> names;
  for (const auto& parameter : method.parameters) names.push_back(parameter.name);
  return names.empty() ? "no parameters" : fmt::format("{}", fmt::join(names, ", "));
}

// Method, its parameters and its samples.
Status read_method(const proto::AmbientOcclusion& m, AoSettings& ao) {
  ao.explicit_method = !m.method().empty();
  if (ao.explicit_method) ao.method = occlusion::find_method(m.method());
  if (ao.method == nullptr) {
    std::vector<std::string> names;
    for (const occlusion::Method* method : occlusion::methods()) names.emplace_back(method->name);
    const auto meant = closest(m.method(), names);
    return Error(fmt::format(
        "ao.method: \"{}\" is none{}", m.method(),
        meant ? fmt::format("; did you mean {}?", *meant) : fmt::format("; there are {}", fmt::join(names, ", "))));
  }
  const occlusion::Method& method = *ao.method;
  ao.parameters = occlusion::fallbacks(method);
  ao.samples = method.samples;
  ao.curve = method.curve;
  for (const auto& [name, value] : m.parameter()) {
    const auto known = std::ranges::find(method.parameters, std::string_view(name), &occlusion::Parameter::name);
    if (known == method.parameters.end())
      return Error(fmt::format("ao.parameter \"{}\": {} has {}", name, method.name, parameter_names(method)));
    const std::string field = fmt::format("ao.parameter \"{}\"", name);
    LFD_TRY_STATUS(check_range(field.c_str(), value, known->least, known->most));
    if (known->is_whole && value != std::floor(value))
      return Error(fmt::format("{}: {}; whole numbers are possible", field, value));
    ao.parameters[static_cast<std::size_t>(known - method.parameters.begin())] = value;
  }
  LFD_TRY_STATUS(check_range("ao.samples", m.samples(), 0, 256));
  if (m.samples() > 0 && method.samples > 0) ao.samples = m.samples();
  if (method.pairs && ao.samples % 2 != 0)
    return Error(fmt::format("ao.samples: {}; {} takes them in pairs", ao.samples, method.name));
  return {};
}

// Whether it can do with fewer samples, directions or slices.
bool has_count(const occlusion::Method& method) {
  return method.samples > 0 || std::ranges::any_of(method.parameters, [](const occlusion::Parameter& one) {
           return one.name == "directions" || one.name == "slices";
         });
}

// What combines with any method.
Status read_options(const proto::AmbientOcclusion& m, AoSettings& ao) {
  LFD_TRY_STATUS(check_range("ao.guard_band_px", m.guard_band_px(), 0, 1024));
  LFD_TRY_STATUS(check_range("ao.least_samples", m.least_samples(), 0, 256));
  LFD_TRY_STATUS(check_range("ao.shared.neighbours", m.shared().neighbours(), 0, 8));
  LFD_TRY_STATUS(check_range("ao.budget_ms", m.budget_ms(), 0, 1e6));
  if (m.shared().open_air() && m.shared().neighbours() == 0)
    return Error("ao.shared.open_air: with neighbours only; ao.shared.neighbours is 0");
  if (m.bent_normals() && !ao.method->directions)
    return Error(fmt::format("ao.bent_normals: {} has no directions", ao.method->name));
  if (m.least_samples() > 0 && !has_count(*ao.method))
    return Error(fmt::format("ao.least_samples: {} looks at as many neighbours everywhere", ao.method->name));
  if (m.shared().open_air() && !ao.method->points)
    return Error(fmt::format("ao.shared.open_air: {} does not ask whether points are hidden", ao.method->name));
  ao.half_resolution = m.half_resolution();
  ao.bent_normals = m.bent_normals();
  ao.guard_band_px = m.guard_band_px();
  ao.least_samples = m.least_samples();
  ao.shared_neighbours = m.shared().neighbours();
  ao.shared_open_air = m.shared().open_air();
  ao.budget_ms = m.budget_ms();
  return {};
}

Result<AoSettings> read_ao(const proto::AmbientOcclusion& m) {
  AoSettings ao;
  if (m.has_enabled()) ao.enabled = m.enabled();
  LFD_TRY_STATUS(read_method(m, ao));
  LFD_TRY_STATUS(check_range("ao.radius_m", m.radius_m(), 0, 1e15));
  LFD_TRY_STATUS(check_range("ao.radius_roi", m.radius_roi(), 0, 1e6));
  LFD_TRY_STATUS(check_range("ao.radii", m.radii(), 0, 8));
  ao.radius_m = m.radius_m();
  if (m.radius_roi() > 0) ao.radius_roi = m.radius_roi();
  if (m.radii() > 0) ao.radii = m.radii();
  ao.generator = static_cast<SampleGenerator>(m.generator());
  LFD_TRY_STATUS(check_range("ao.generator", m.generator(), 0, 3));
  ao.seed = m.seed();
  LFD_TRY_STATUS(read_options(m, ao));
  if (m.has_curve()) ao.curve = {m.curve().a(), m.curve().b(), m.curve().c()};
  LFD_TRY_STATUS(check_range("ao.curve.a", ao.curve.a, -1, 1));
  LFD_TRY_STATUS(check_range("ao.curve.b", ao.curve.b, 1e-3, 1e3));
  LFD_TRY_STATUS(check_range("ao.curve.c", ao.curve.c, 1e-3, 1e3));
  if (m.blur().has_enabled()) ao.blur_enabled = m.blur().enabled();
  if (m.blur().sigma_px() != 0) ao.blur_sigma_px = m.blur().sigma_px();
  LFD_TRY_STATUS(check_range("ao.blur.sigma_px", ao.blur_sigma_px, 0.1, 8));
  LFD_TRY_STATUS(check_range("ao.blur.kind", m.blur().kind(), 0, 1));
  // What modules gather agrees between neighbours; across an outline a Gaussian would mix in what each sees behind it.
  const bool by_geometry = ao.shared_neighbours > 0 && m.blur().sigma_px() == 0;
  ao.blur = m.blur().has_kind() ? static_cast<AoBlur>(m.blur().kind())
            : by_geometry       ? AoBlur::kGeometry
                                : AoBlur::kGaussian;
  LFD_TRY_STATUS(check_range("ao.blur.taps", m.blur().taps(), 0, 3));
  if (m.blur().taps() > 0) ao.blur_taps = m.blur().taps();
  LFD_TRY_STATUS(check_range("ao.target", m.target(), 0, 1));
  ao.target = static_cast<AoTarget>(m.target());
  return ao;
}

std::size_t index_of(const occlusion::Method& method, std::string_view name) {
  const auto known = std::ranges::find(method.parameters, name, &occlusion::Parameter::name);
  LFD_CHECK(known != method.parameters.end(), "the method has such a parameter");
  return static_cast<std::size_t>(known - method.parameters.begin());
}

}  // namespace

double& AoSettings::parameter(std::string_view name) { return parameters[index_of(*method, name)]; }

double AoSettings::parameter(std::string_view name) const { return parameters[index_of(*method, name)]; }

std::string blur_text(const AoSettings& ao) {
  if (!ao.blur_enabled) return "off";
  if (ao.blur == AoBlur::kGaussian) return fmt::format("Gaussian, sigma {:g} px", ao.blur_sigma_px);
  return fmt::format("by geometry, {} taps a side", ao.blur_taps);
}

std::vector<glm::vec4> AoSettings::sample_set() const {
  if (method->sample_set == nullptr) return {};
  const occlusion::SampleChoice choice{generator, samples, seed};
  std::vector<glm::vec4> set = method->sample_set(choice, parameters);
  if (least_samples > 0) occlusion::spread_prefixes(set, choice);
  return set;
}

Result<RenderSettings> read_settings(const proto::RenderSettings& m) {
  RenderSettings settings;
  LFD_TRY(settings.ao, read_ao(m.ao()));
  for (const double part : {m.background().r(), m.background().g(), m.background().b()}) {
    LFD_TRY_STATUS(check_range("background", part, 0, 1));
  }
  settings.background = {m.background().r(), m.background().g(), m.background().b()};
  LFD_TRY_STATUS(check_range("planner", m.planner(), 0, 1));
  settings.plan = m.planner() == proto::RenderSettings::PLAN;
  if (m.subdivision_px() != 0) settings.subdivision_px = m.subdivision_px();
  LFD_TRY_STATUS(check_range("position", m.position(), 0, 1));
  settings.interpolated_position = m.position() == proto::RenderSettings::INTERPOLATED;
  if (m.tessellation_px() != 0) LFD_TRY_STATUS(check_range("tessellation_px", m.tessellation_px(), 0.01, 1e4));
  settings.tessellation_px = m.tessellation_px();
  if (settings.tessellation_px > 0 && !settings.interpolated_position) {
    return Error("tessellation_px: with position INTERPOLATED only: a fragment of a patch cannot tell its triangle");
  }
  if (m.warp_level() != 0) LFD_TRY_STATUS(check_range("warp_level", m.warp_level(), 4, 9));
  settings.warp_level = m.warp_level();
  LFD_TRY_STATUS(check_range("subdivision_px", settings.subdivision_px, 0.01, 1e4));
  if (m.has_near_z_m()) settings.near_z_m = m.near_z_m();
  if (m.has_far_z_m()) settings.far_z_m = m.far_z_m();
  for (const auto& z : {settings.near_z_m, settings.far_z_m}) {
    if (z && !std::isfinite(*z)) return Error("near_z_m, far_z_m: must be finite");
  }
  if (settings.near_z_m && settings.far_z_m && !(*settings.far_z_m < *settings.near_z_m)) {
    return Error(fmt::format("far_z_m: {} must be less than near_z_m, {}: z grows toward the viewer", *settings.far_z_m,
                             *settings.near_z_m));
  }
  settings.unlit = m.unlit();
  LFD_TRY(settings.pattern, read_pattern(m.pattern()));
  return settings;
}

Status check_radius(const AoSettings& ao, const RegionOfInterest& roi) {
  const double radius_m = ao.radius_in_world_m(roi.diagonal_m());
  if (!ao.enabled || radius_m >= kLeastAoRadius * roi.diagonal_m()) return {};
  return Error(
      fmt::format("ao: {}: the radius of {:g} m is less than {:g} of the region of interest's diagonal, {:g} m",
                  ao.radius_m > 0 ? "radius_m" : "radius_roi", radius_m, kLeastAoRadius, roi.diagonal_m()));
}

Result<RegionOfInterest> read_roi(const proto::RegionOfInterest& m) {
  RegionOfInterest roi;
  roi.world_centre = point_from<World>(m.world_centre());
  roi.world_size = size_from(m.world_size());
  if (m.has_world_orientation()) {
    const auto& q = m.world_orientation();
    roi.world_orientation = glm::dquat(q.w(), q.x(), q.y(), q.z());
  }
  roi.physical_centre = point_from<Physical>(m.physical_centre());
  roi.physical_size = size_from(m.physical_size());
  if (auto status = validate(roi); !status) return status.error().within("roi");
  return roi;
}

proto::RegionOfInterest write_roi(const RegionOfInterest& roi) {
  proto::RegionOfInterest m;
  set_vector(m.mutable_world_centre(), roi.world_centre);
  set_vector(m.mutable_world_size(), roi.world_size);
  m.mutable_world_orientation()->set_w(roi.world_orientation.w);
  m.mutable_world_orientation()->set_x(roi.world_orientation.x);
  m.mutable_world_orientation()->set_y(roi.world_orientation.y);
  m.mutable_world_orientation()->set_z(roi.world_orientation.z);
  set_vector(m.mutable_physical_centre(), roi.physical_centre);
  set_vector(m.mutable_physical_size(), roi.physical_size);
  return m;
}

Result<RegionOfInterest> complete_roi(const proto::RegionOfInterest& message, Point3<World> low, Point3<World> high,
                                      double screen_width_m, double screen_height_m) {
  proto::RegionOfInterest m = message;
  const RegionOfInterest bounds = fit_to_screen(low, high, screen_width_m, screen_height_m);
  if (!m.has_world_centre()) set_vector(m.mutable_world_centre(), bounds.world_centre);
  if (!m.has_world_size()) set_vector(m.mutable_world_size(), bounds.world_size);
  if (!m.has_physical_size()) {
    const glm::dvec3 size = size_from(m.world_size());
    set_vector(m.mutable_physical_size(), size * std::min(screen_width_m / size.x, screen_height_m / size.y));
  }
  return read_roi(m);
}

Result<RegionOfInterest> complete_roi(const proto::RegionOfInterest& message, const proto::Scene& scene,
                                      ScreenSize screen) {
  return complete_roi(message, point_from<World>(scene.bounds_low()), point_from<World>(scene.bounds_high()),
                      screen.width_m, screen.height_m);
}

void set_box(proto::Vector& centre, proto::Vector& size, std::span<const double> numbers) {
  LFD_CHECK(numbers.size() == 6, "a box is centre and edge lengths");
  set_vector(&centre, glm::dvec3(numbers[0], numbers[1], numbers[2]));
  set_vector(&size, glm::dvec3(numbers[3], numbers[4], numbers[5]));
}

}  // namespace lfd
