// Ambient occlusion as it is rendered, pixel by pixel, beside the method's own limit at the same points.
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <vector>

#include "bench/reference/ao_limit.h"
#include "bench/reference/method_limit.h"
#include "bench/reference/ray_occlusion.h"
#include "controller/scene/made/made_scenes.h"
#include "tests/support/rendering.h"

namespace lfd::testing_support {

// A pixel with a surface.
struct AoPixel {
  PixelIndex at;
  Point3<World> p;
  double ao = 0;  // after the curve
};

// Sphere samples of radius R (world) without blur; the curve changes nothing, so that pixels hold shares of hidden
// samples.
inline proto::AmbientOcclusion plain_ao(double radius_m, int samples, proto::AmbientOcclusion::Generator generator) {
  proto::AmbientOcclusion ao;
  ao.set_radius_m(radius_m);
  ao.set_samples(samples);
  ao.set_generator(generator);
  ao.mutable_curve()->set_a(0);
  ao.mutable_curve()->set_b(1);
  ao.mutable_curve()->set_c(1);
  ao.mutable_blur()->set_enabled(false);
  return ao;
}

inline const std::vector<proto::AmbientOcclusion::Generator>& all_generators() {
  static const std::vector<proto::AmbientOcclusion::Generator> kAll{
      proto::AmbientOcclusion::UNIFORM, proto::AmbientOcclusion::JITTERED, proto::AmbientOcclusion::LATIN_SQUARE,
      proto::AmbientOcclusion::POISSON_DISK};
  return kAll;
}

inline SceneData made(const char* name) {
  auto scene = scene::make_scene(name, 1);
  LFD_CHECK(scene, scene.error().message());
  return scene->data;
}

// The corner of the made box, seen from above and from the right, so that floor and walls are well in view.
inline RegionOfInterest from_above() {
  RegionOfInterest roi;
  roi.world_centre = {-0.6, -0.4, -0.35};
  roi.physical_size = {1.35, 1.35, 1.35};
  roi.world_orientation = glm::angleAxis(0.6, glm::dvec3(0, 1, 0)) * glm::angleAxis(-0.6, glm::dvec3(1, 0, 0));
  return roi;
}

// One scene before one module.
class AoStage {
 public:
  AoStage(SceneData data, const RegionOfInterest& roi, DisplayCalibration display, std::uint32_t module = 0)
      : data_(std::move(data)),
        roi_(roi),
        display_(std::move(display)),
        module_(module),
        renderer_(context(), display_, {module}) {
    auto scene = reference::world_scene(data_, roi_);
    LFD_CHECK(scene, scene.error().message());
    scene_ = std::make_unique<const reference::WorldScene>(*std::move(scene));
    intersector_ = std::make_unique<const reference::Intersector>(*scene_);
  }

  const DisplayCalibration& display() const { return display_; }

  // Colour, positions, ambient occlusion, and what else is asked for.
  FrameResult draw_buffers(const proto::AmbientOcclusion& ao, std::initializer_list<proto::BufferKind> more = {}) {
    proto::RenderSettings settings;
    *settings.mutable_ao() = ao;
    FrameOptions options{.buffers = buffers({proto::POSITION, proto::AO}), .reuse = false};
    options.buffers.bits |= buffers(more).bits;
    return draw_once(renderer_, state_of(data_, roi_, settings), data_.assets, options);
  }

  // Pixels with a surface, rows from the top.
  std::vector<AoPixel> draw(const proto::AmbientOcclusion& ao) {
    const FrameResult result = draw_buffers(ao);
    const ModuleImage* position = find_image(result, module_, proto::POSITION);
    const ModuleImage* shares = find_image(result, module_, proto::AO);
    LFD_CHECK(position != nullptr && shares != nullptr, "both were asked for");
    const auto p = floats_of(*position), share = floats_of(*shares);
    const Point3<World> origin = result.position_origin;
    std::vector<AoPixel> pixels;
    for (std::size_t i = 0; i < p.size(); i += 4) {
      EXPECT_EQ(p[i + 3], share[i + 3]) << "ambient occlusion is where surfaces are";
      if (p[i + 3] == 0) continue;
      const int number = static_cast<int>(i / 4), width = display_.image.width;
      pixels.push_back(
          {{number % width, number / width}, {p[i] + origin.x, p[i + 1] + origin.y, p[i + 2] + origin.z}, share[i]});
    }
    return pixels;
  }

  // What a method converges to at a pixel, before the curve; absent where it shows no surface.
  std::optional<double> method_limit(PixelIndex at, const AoSettings& settings, double radius_m,
                                     const reference::LimitEffort& effort) const {
    const reference::ModuleView view{display_, display_.modules[module_], {}};
    const auto hit = reference::cast_point(*intersector_, view, centre_of(at));
    if (!hit) return std::nullopt;
    return reference::method_limit(*intersector_, view, reference::spot_of(view, *scene_, *hit), settings, radius_m,
                                   effort);
  }

  // Of the surface that a pixel shows; absent where it shows none.
  std::optional<reference::RayOcclusion> rays(PixelIndex at, double radius_m,
                                              const reference::RayChoice& choice) const {
    const reference::ModuleView view{display_, display_.modules[module_], {}};
    const auto hit = reference::cast_point(*intersector_, view, centre_of(at));
    if (!hit) return std::nullopt;
    return reference::ray_occlusion(*intersector_, reference::spot_of(view, *scene_, *hit), {radius_m}, choice)[0];
  }

  reference::AoLimit limit(Point3<World> p, const AoSettings& settings, const reference::AoSampling& sampling) const {
    return reference::ao_limit(*intersector_, {display_, display_.modules[module_], {}}, p, settings, sampling);
  }

  // How many pixels wide and high the bounds of a sphere of this radius (world) about p are, halved: absent where a
  // part of it has no image.
  std::optional<glm::dvec2> reach_px(Point3<World> p, double radius_m) const {
    const auto at = [&](Vector3<World> d) {
      return image_from_physical(display_, display_.modules[module_], physical_from_world(roi_) * (p + d));
    };
    const auto centre = at({});
    glm::dvec2 reach(0);
    for (int i = 0; i < 64; ++i) {
      const double z = (i + 0.5) / 32 - 1, r = std::sqrt(1 - z * z), phi = 2.39996 * i;
      const auto q = at(radius_m * Vector3<World>{r * std::cos(phi), r * std::sin(phi), z});
      if (!centre || !q) return std::nullopt;
      reach = glm::max(reach, glm::abs(glm::dvec2(q->u - centre->u, q->v - centre->v)));
    }
    return reach;
  }

 private:
  SceneData data_;
  RegionOfInterest roi_;
  DisplayCalibration display_;
  std::uint32_t module_;
  Renderer renderer_;
  std::unique_ptr<const reference::WorldScene> scene_;
  std::unique_ptr<const reference::Intersector> intersector_;
};

// `count` of the pixels, evenly spread.
inline std::vector<AoPixel> spread(const std::vector<AoPixel>& pixels, std::size_t count) {
  if (pixels.size() <= count) return pixels;
  std::vector<AoPixel> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(pixels[(2 * i + 1) * pixels.size() / (2 * count)]);
  return chosen;
}

}  // namespace lfd::testing_support
