// What settings are compared on: one module of one scene on one display.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/reference/caster.h"
#include "bench/reference/intersector.h"
#include "controller/scene/loaded_scene.h"
#include "proto/deployment_file.h"
#include "rendernode/geometry/depth_limits.h"

namespace lfd::bench {

// A scene as a deployment shows it, and as the reference sees it.
class ShownScene {
 public:
  // `size` absent: the display's own images. Errors: files, a scene that the reference cannot read.
  static Result<std::unique_ptr<const ShownScene>> load(const std::filesystem::path& deployment,
                                                        const DeploymentOverrides& overrides,
                                                        const std::optional<ImageSize>& size);

  // The same scene on the display with images of another size.
  Result<std::unique_ptr<const ShownScene>> of_size(ImageSize size) const;

  const std::string& name() const { return name_; }
  const DisplayCalibration& display() const { return deployment_.display; }
  const RegionOfInterest& roi() const { return roi_; }
  const Assets& assets() const { return loaded_.data.assets; }
  const reference::Intersector& intersector() const { return *intersector_; }
  reference::ModuleView view(std::uint32_t module) const;

  // The deployment's settings and these of ambient occlusion; the planner is on.
  proto::State state(const proto::AmbientOcclusion& ao) const;

  // Tells scenes on displays apart: a hash of all that a ray can meet.
  const std::string& hash() const { return hash_; }

 private:
  ShownScene() = default;
  ShownScene(const ShownScene&) = default;

  void renew_hash();

  std::string name_, hash_;
  Deployment deployment_;
  LoadedScene loaded_;
  RegionOfInterest roi_;
  DepthLimits limits_;
  std::shared_ptr<const reference::WorldScene> world_;
  std::shared_ptr<const reference::Intersector> intersector_;
};

// The same display with images of another size: its maps are scaled. Errors: a size beyond kMaxImageSide_px.
Result<DisplayCalibration> resized(const DisplayCalibration& display, ImageSize size);

// How many pixels of a module's image a length (m, in the world) across its lines is, the mean over its surfaces and
// over right and up; 0 where it shows none.
double mean_length_px(const ShownScene& scene, std::uint32_t module, const reference::HitImage& hits, double length_m);

}  // namespace lfd::bench
