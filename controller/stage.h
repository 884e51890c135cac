// The running scene and how it is to be drawn: wishes come in, checked and numbered updates of the state go out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/result.h"
#include "calibration/spaces/roi.h"
#include "controller/scene/loaded_scene.h"
#include "controller/state_store.h"
#include "proto/deployment_file.h"

namespace lfd::controller {

class Stage {
 public:
  // What is shown of `deployment` before anybody wishes otherwise; no scene is there yet. Errors name the field.
  static Result<Stage> of(const Deployment& deployment);

  bool has_scene() const { return scene_.has_value(); }
  const StateStore& store() const { return store_; }
  const RegionOfInterest& roi() const { return roi_; }                           // of the scene that is there
  const Assets& assets() const { return scene_->data.assets; }                   // likewise
  const std::vector<std::string>& warnings() const { return scene_->warnings; }  // likewise

  // Each changes the state and returns the update to publish; an error changes nothing. One of show(): the scene and
  // the display do not fit into one message.
  Result<proto::Update> show(LoadedScene scene);
  // What show() would make of it now, without a number; nothing is changed.
  Result<proto::Update> preview(const LoadedScene& scene) const;
  Result<proto::Update> set_roi(const proto::RegionOfInterest& wish);  // boxes left out follow from the scene's bounds
  Result<proto::Update> set_render(const proto::RenderSettings& render);
  Result<proto::Update> set_ao(const proto::AmbientOcclusion& ao);
  Result<proto::Update> set_pattern(const proto::TestPattern& pattern);  // without a kind: the scene again
  std::optional<proto::Update> set_buffers(std::uint32_t buffers);       // absent: they are those already

  // What was recorded of another show; `assets` come with a scene. Unlike wishes it is taken as it is: an error says
  // what of it cannot be drawn on this display.
  Result<proto::Update> show_recorded(proto::Update recorded, std::optional<Assets> assets);

  // An update that changes nothing of the state (where the display is), numbered like the others.
  proto::Update number(proto::Update update) { return store_.change(std::move(update)); }

  // Moves what moves to its place at frame / (frames per second of the deployment), so that pictures do not depend on
  // how fast frames come. The update names only what is not there yet; absent where all is.
  std::optional<proto::Update> animate(std::uint64_t frame);

 private:
  Stage(const Deployment& deployment);
  Result<RegionOfInterest> complete(const proto::RegionOfInterest& wish, const proto::Scene& scene) const;
  // Settings that can be drawn on this display with this region of interest.
  Status check_together(const proto::RenderSettings& render, const RegionOfInterest& roi) const;
  // Whether the scene and the display fit into one message.
  Status check_size(const proto::Scene& scene) const;

  ScreenSize screen_;
  ImageSize image_;
  int module_count_;
  std::size_t display_bytes_;  // of the display in a message
  double animation_frames_per_second_;
  proto::RegionOfInterest wished_roi_;
  proto::RenderSettings render_;
  std::optional<LoadedScene> scene_;
  RegionOfInterest roi_;
  StateStore store_;
};

}  // namespace lfd::controller
