// Wishes to updates.
#include "controller/stage.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/check.h"
#include "base/log.h"
#include "calibration/guard_band.h"
#include "proto/calibration_file.h"
#include "proto/settings.h"
#include "proto/state.h"
#include "proto/wire/socket.h"

namespace lfd::controller {
namespace {

constexpr std::size_t kMostStateBytes =
    wire::kSmallMessages.max_part_bytes - (std::size_t{1} << 20);  // beside the rest

// Bit by bit, as hashes see them: 0 is not -0.
template <class Numbers>
bool same_numbers(const Numbers& a, const Numbers& b) {
  return std::ranges::equal(
      a, b, [](double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); });
}

}  // namespace

Stage::Stage(const Deployment& deployment)
    : screen_(deployment.display.screen),
      image_(deployment.display.image),
      module_count_(static_cast<int>(deployment.display.modules.size())),
      display_bytes_(write_calibration(deployment.display).ByteSizeLong()),
      animation_frames_per_second_(deployment.animation_frames_per_second),
      wished_roi_(deployment.message.roi()),
      render_(deployment.message.render()) {}

Result<Stage> Stage::of(const Deployment& deployment) {
  Stage stage(deployment);
  LFD_CHECK(stage.animation_frames_per_second_ > 0, "a deployment that was read has a rate of animation");
  if (auto settings = read_settings(stage.render_); !settings) return settings.error().within("render");
  return stage;
}

Result<RegionOfInterest> Stage::complete(const proto::RegionOfInterest& wish, const proto::Scene& scene) const {
  return complete_roi(wish, scene, screen_);
}

Status Stage::check_together(const proto::RenderSettings& render, const RegionOfInterest& roi) const {
  LFD_TRY(const RenderSettings settings, read_settings(render));
  if (const Status fits = check_guard_band(image_, settings.ao.guard_band_px); !fits)
    return fits.error().within("ao.guard_band_px");
  LFD_TRY_STATUS(check_modules(settings.pattern, module_count_));
  return check_radius(settings.ao, roi);
}

Status Stage::check_size(const proto::Scene& scene) const {
  const std::size_t bytes = scene.ByteSizeLong() + display_bytes_;
  if (bytes <= kMostStateBytes) return {};
  return Error(fmt::format("{} MiB of instances, materials and measured maps; nodes are sent at most {} MiB at once",
                           bytes >> 20, kMostStateBytes >> 20));
}

Result<proto::Update> Stage::preview(const LoadedScene& scene) const {
  LFD_TRY(const RegionOfInterest roi, complete(wished_roi_, scene.data.scene));
  LFD_TRY_STATUS(check_together(render_, roi));
  LFD_TRY_STATUS(check_size(scene.data.scene));
  proto::Update update;
  *update.mutable_scene() = scene.data.scene;
  *update.mutable_roi() = write_roi(roi);
  *update.mutable_render() = render_;
  return update;
}

Result<proto::Update> Stage::show(LoadedScene scene) {
  LFD_TRY(proto::Update update, preview(scene));
  LFD_TRY(roi_, complete(wished_roi_, scene.data.scene));
  scene_ = std::move(scene);
  return store_.change(std::move(update));
}

Result<proto::Update> Stage::set_roi(const proto::RegionOfInterest& wish) {
  if (!has_scene()) return Error("no scene is there yet");
  LFD_TRY(const RegionOfInterest roi, complete(wish, scene_->data.scene));
  LFD_TRY_STATUS(check_together(render_, roi));
  roi_ = roi;
  wished_roi_ = wish;
  proto::Update update;
  *update.mutable_roi() = write_roi(roi_);
  return store_.change(std::move(update));
}

Result<proto::Update> Stage::set_render(const proto::RenderSettings& render) {
  if (!has_scene()) return Error("no scene is there yet");
  LFD_TRY_STATUS(check_together(render, roi_));
  render_ = render;
  proto::Update update;
  *update.mutable_render() = render_;
  return store_.change(std::move(update));
}

Result<proto::Update> Stage::set_ao(const proto::AmbientOcclusion& ao) {
  proto::RenderSettings render = render_;
  *render.mutable_ao() = ao;
  return set_render(render);
}

Result<proto::Update> Stage::set_pattern(const proto::TestPattern& pattern) {
  proto::RenderSettings render = render_;
  if (same_message(pattern, proto::TestPattern())) {
    render.clear_pattern();
  } else {
    *render.mutable_pattern() = pattern;
  }
  return set_render(render);
}

std::optional<proto::Update> Stage::set_buffers(std::uint32_t buffers) {
  if (store_.state().buffers() == buffers) return std::nullopt;
  proto::Update update;
  update.set_buffers(buffers);
  return store_.change(std::move(update));
}

Result<proto::Update> Stage::show_recorded(proto::Update recorded, std::optional<Assets> assets) {
  LFD_CHECK(recorded.has_scene() == assets.has_value(), "a scene comes with its assets");
  LFD_CHECK(recorded.has_scene() || has_scene(), "a show begins with a scene");
  const proto::RenderSettings& render = recorded.has_render() ? recorded.render() : render_;
  RegionOfInterest roi = roi_;
  if (recorded.has_roi()) {
    LFD_TRY(roi, read_roi(recorded.roi()));
  }
  LFD_TRY_STATUS(check_together(render, roi));
  if (recorded.has_scene()) {
    LFD_TRY_STATUS(check_size(recorded.scene()));
    scene_ = LoadedScene{.data = {recorded.scene(), *std::move(assets)}, .animations = {}, .warnings = {}};
  }
  roi_ = roi;
  render_ = render;
  return store_.change(std::move(recorded));
}

std::optional<proto::Update> Stage::animate(std::uint64_t frame) {
  if (!has_scene() || scene_->animations.empty()) return std::nullopt;
  const double duration_s = scene_->animations.duration_s();
  const double played_s = static_cast<double>(frame) / animation_frames_per_second_;
  const double time_s = duration_s > 0 ? std::fmod(played_s, duration_s) : 0;
  scene::Moved moved = scene_->animations.at(time_s);
  const proto::Scene& shown = store_.state().scene();
  proto::Update update;
  for (proto::MovedInstance& one : moved.instances) {
    const proto::Instance& now = shown.instance(static_cast<int>(one.index()));
    if (one.mesh() == now.mesh()) one.clear_mesh();
    if (one.mesh().empty() && same_numbers(one.world_from_mesh(), now.world_from_mesh())) continue;
    *update.add_moved_instance() = std::move(one);
  }
  for (proto::MovedLight& one : moved.lights) {
    // Byte by byte, as hashes see it.
    if (one.light().SerializeAsString() == shown.light(static_cast<int>(one.index())).SerializeAsString()) continue;
    *update.add_moved_light() = std::move(one);
  }
  if (!moves(update)) return std::nullopt;
  return store_.change(std::move(update));
}

}  // namespace lfd::controller
