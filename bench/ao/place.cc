// Loading, and lengths in pixels.
#include "bench/ao/place.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/hash.h"
#include "base/log.h"
#include "bench/common/shown_scene.h"
#include "calibration/maps/pinhole.h"
#include "proto/calibration_file.h"
#include "proto/state.h"

namespace lfd::bench {
namespace {

struct Scale {
  double u, v;
};

ScreenMap scaled(const IdealMap& map, Scale) { return map; }

ScreenMap scaled(HomographyMap map, Scale by) {
  for (int column = 0; column < 3; ++column) {
    map.image_from_screen[column].x *= by.u;
    map.image_from_screen[column].y *= by.v;
  }
  return map;
}

ScreenMap scaled(PinholeMap map, Scale by) {
  map.focal_u_px *= by.u;
  map.principal_u_px *= by.u;
  map.focal_v_px *= by.v;
  map.principal_v_px *= by.v;
  return map;
}

ScreenMap scaled(const GridMap& map, Scale by) {
  GridNodes nodes = map.nodes();
  nodes.first_u_px *= by.u;
  nodes.step_u_px *= by.u;
  nodes.first_v_px *= by.v;
  nodes.step_v_px *= by.v;
  auto made = GridMap::make(std::move(nodes));
  LFD_CHECK(made, "positive scales keep a grid's faults away");
  return *std::move(made);
}

}  // namespace

Result<DisplayCalibration> resized(const DisplayCalibration& display, ImageSize size) {
  if (size.width < 1 || size.height < 1 || size.width > kMaxImageSide_px || size.height > kMaxImageSide_px)
    return Error(
        fmt::format("images of {}x{}: 1 to {} pixels a side are possible", size.width, size.height, kMaxImageSide_px));
  DisplayCalibration other = display;
  const Scale by{static_cast<double>(size.width) / display.image.width,
                 static_cast<double>(size.height) / display.image.height};
  other.image = size;
  for (ModuleCalibration& module : other.modules)
    module.map = std::visit([&](const auto& map) { return scaled(map, by); }, module.map);
  return other;
}

Result<std::unique_ptr<const ShownScene>> ShownScene::load(const std::filesystem::path& deployment,
                                                           const DeploymentOverrides& overrides,
                                                           const std::optional<ImageSize>& size) {
  std::unique_ptr<ShownScene> scene(new ShownScene);
  LFD_TRY(scene->deployment_, load_deployment(deployment, overrides));
  Deployment& d = scene->deployment_;
  if (size) {
    LFD_TRY(d.display, resized(d.display, *size));
  }
  scene->name_ = shown_scene_name(d);
  LFD_TRY(scene->loaded_, load_shown_scene(d));
  for (const std::string& warning : scene->loaded_.warnings) log::warn("{}", warning);
  LFD_TRY(scene->roi_, complete_roi(d.message.roi(), scene->loaded_.data.scene, d.display.screen));
  scene->limits_ = depth_limits(d.display, d.render);
  LFD_TRY(reference::WorldScene world, reference::world_scene(scene->loaded_.data, scene->roi_));
  scene->world_ = std::make_shared<const reference::WorldScene>(std::move(world));
  scene->intersector_ = std::make_shared<const reference::Intersector>(*scene->world_);
  scene->renew_hash();
  return std::unique_ptr<const ShownScene>(std::move(scene));
}

Result<std::unique_ptr<const ShownScene>> ShownScene::of_size(ImageSize size) const {
  std::unique_ptr<ShownScene> other(new ShownScene(*this));
  LFD_TRY(other->deployment_.display, resized(display(), size));
  other->limits_ = depth_limits(other->display(), deployment_.render);
  other->renew_hash();
  return std::unique_ptr<const ShownScene>(std::move(other));
}

void ShownScene::renew_hash() { hash_ = content_hash(state_hash(state({})) + calibration_hash(display())); }

reference::ModuleView ShownScene::view(std::uint32_t module) const {
  return {display(), display().modules[module], {limits_.front, limits_.back}};
}

proto::State ShownScene::state(const proto::AmbientOcclusion& ao) const {
  proto::State state;
  state.set_sequence(1);
  *state.mutable_scene() = loaded_.data.scene;
  *state.mutable_roi() = write_roi(roi_);
  *state.mutable_render() = deployment_.message.render();
  state.mutable_render()->set_planner(proto::RenderSettings::PLAN);
  *state.mutable_render()->mutable_ao() = ao;
  return state;
}

double mean_length_px(const ShownScene& scene, std::uint32_t module, const reference::HitImage& hits, double length_m) {
  constexpr std::size_t kEvery = 97;  // pixels; a prime, so that no column is preferred
  const Affine<Physical, World> to_physical = physical_from_world(scene.roi());
  const glm::dmat3 from_physical = world_from_physical(scene.roi()).linear;
  const DisplayCalibration& display = scene.display();
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < hits.hit.size(); i += kEvery) {
    if (!hits.hit[i]) continue;
    for (int axis = 0; axis < 2; ++axis) {
      const glm::dvec3 half = 0.05 * length_m * glm::normalize(from_physical[axis]);
      const Vector3<World> step{half.x, half.y, half.z};
      const auto at = [&](Point3<World> p) {
        return image_from_physical(display, display.modules[module], to_physical * p);
      };
      const auto one = at(hits.hit[i]->world + step), other = at(hits.hit[i]->world + -1.0 * step);
      if (!one || !other) continue;
      sum += std::hypot(one->u - other->u, one->v - other->v) / 0.1;
      ++count;
    }
  }
  return count == 0 ? 0 : sum / count;
}

}  // namespace lfd::bench
