// Fuzz target: glTF files are refused with a reason that names the file, or are scenes whose every number and index can
// be trusted.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/check.h"
#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "controller/scene/loaded_scene.h"
#include "controller/scene/scene_file.h"
#include "proto/scene_numbers.h"

namespace {

void check_instances(const google::protobuf::RepeatedPtrField<lfd::proto::Instance>& instances,
                     const lfd::SceneData& data) {
  for (const lfd::proto::Instance& instance : instances) {
    LFD_CHECK(instance.material() < static_cast<std::uint32_t>(data.scene.material_size()), "its material is there");
    LFD_CHECK(instance.world_from_mesh_size() == 12, "it has a place");
    LFD_CHECK(data.assets.contains(instance.mesh()), "its mesh is there");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const lfd::TemporaryFolder kFolder = *lfd::TemporaryFolder::make("lfd-fuzz-gltf");
  [[maybe_unused]] static const bool kQuiet = (lfd::start_log("fuzz", "off"), true);
  const auto path = kFolder.path() / "f.gltf";
  LFD_CHECK(lfd::write_file(path, {reinterpret_cast<const char*>(data), size}), "it can be written");
  const auto scene = lfd::load_scene(path);
  if (!scene) {
    LFD_CHECK(scene.error().message().starts_with(path.string() + ": "), "every refusal names the file");
    return 0;
  }
  const auto census = lfd::scene::census_of(scene->data);
  LFD_CHECK(census, census.error().message());
  const lfd::Status numbers = lfd::check_numbers(scene->data.scene);
  LFD_CHECK(numbers, numbers.error().message());
  check_instances(scene->data.scene.instance(), scene->data);
  if (scene->animations.empty()) return 0;
  const double duration_s = scene->animations.duration_s();
  LFD_CHECK(std::isfinite(duration_s) && duration_s >= 0, "an animation takes some time");
  for (const double time_s : {0.0, duration_s / 3, duration_s}) {
    lfd::proto::Scene moved = scene->data.scene;
    for (const auto& one : scene->animations.at(time_s).instances) {
      LFD_CHECK(one.index() < static_cast<std::uint32_t>(moved.instance_size()), "what moves is there");
      lfd::proto::Instance& instance = *moved.mutable_instance(static_cast<int>(one.index()));
      instance.set_mesh(one.mesh());
      *instance.mutable_world_from_mesh() = one.world_from_mesh();
    }
    for (const auto& one : scene->animations.at(time_s).lights) {
      LFD_CHECK(one.index() < static_cast<std::uint32_t>(moved.light_size()), "what moves is there");
      *moved.mutable_light(static_cast<int>(one.index())) = one.light();
    }
    check_instances(moved.instance(), scene->data);
    const lfd::Status finite = lfd::check_numbers(moved);
    LFD_CHECK(finite, finite.error().message());
  }
  return 0;
}
