// Updates and hash of the distributed state.
#include "proto/state.h"

#include <google/protobuf/util/message_differencer.h>

#include <algorithm>

#include "base/log.h"
#include "proto/state_hasher.h"

namespace lfd {
namespace {

constexpr int kPlaceNumbers = 12;

Status check_moves(const proto::Update& update, const proto::Scene& scene) {
  for (const proto::MovedInstance& moved : update.moved_instance()) {
    if (moved.index() >= static_cast<std::uint32_t>(scene.instance_size()))
      return Error(fmt::format("moves instance {}; the scene has {}", moved.index(), scene.instance_size()));
    if (moved.world_from_mesh_size() != kPlaceNumbers)
      return Error(fmt::format("moves instance {} to a place of {} numbers; {} are needed", moved.index(),
                               moved.world_from_mesh_size(), kPlaceNumbers));
  }
  for (const proto::MovedLight& moved : update.moved_light()) {
    if (moved.index() >= static_cast<std::uint32_t>(scene.light_size()))
      return Error(fmt::format("moves light {}; the scene has {}", moved.index(), scene.light_size()));
  }
  return {};
}

void move(proto::Scene& scene, const proto::Update& update) {
  for (const proto::MovedInstance& moved : update.moved_instance()) {
    proto::Instance& instance = *scene.mutable_instance(static_cast<int>(moved.index()));
    if (!moved.mesh().empty()) instance.set_mesh(moved.mesh());
    *instance.mutable_world_from_mesh() = moved.world_from_mesh();
  }
  for (const proto::MovedLight& moved : update.moved_light())
    *scene.mutable_light(static_cast<int>(moved.index())) = moved.light();
}

}  // namespace

std::string state_hash(const proto::State& state) { return StateHasher(state).hash(); }

Status apply_update(proto::State& state, const proto::Update& update) {
  if (update.sequence() != state.sequence() + 1) {
    return Error(fmt::format("update {} does not follow state {}", update.sequence(), state.sequence()));
  }
  const proto::Scene& scene = update.has_scene() ? update.scene() : state.scene();
  if (const Status fits = check_moves(update, scene); !fits)
    return Error(fmt::format("update {} {}", update.sequence(), fits.error().message()));
  if (update.has_scene()) *state.mutable_scene() = update.scene();
  if (update.has_roi()) *state.mutable_roi() = update.roi();
  if (update.has_render()) *state.mutable_render() = update.render();
  if (update.has_buffers()) state.set_buffers(update.buffers());
  if (moves(update)) move(*state.mutable_scene(), update);
  state.set_sequence(update.sequence());
  return {};
}

bool moves(const proto::Update& update) { return update.moved_instance_size() > 0 || update.moved_light_size() > 0; }

bool names_assets(const proto::Update& update) {
  return update.has_scene() ||
         std::ranges::any_of(update.moved_instance(), [](const auto& moved) { return !moved.mesh().empty(); });
}

bool same_message(const google::protobuf::Message& a, const google::protobuf::Message& b) {
  return google::protobuf::util::MessageDifferencer::Equals(a, b);
}

bool same_materials(const proto::Scene& a, const proto::Scene& b) {
  return std::ranges::equal(a.material(), b.material(), same_message);
}

bool same_instances(const proto::Scene& a, const proto::Scene& b) {
  return std::ranges::equal(a.instance(), b.instance(), same_message);
}

}  // namespace lfd
