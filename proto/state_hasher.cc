// Parts' bytes to one hash.
#include "proto/state_hasher.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include "base/check.h"

namespace lfd {
namespace {

void append(std::string& bytes, std::uint64_t number) {
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(number >> 8 * i & 0xFF);
}

void append(std::string& bytes, const Hash128& hash) {
  append(bytes, hash.high);
  append(bytes, hash.low);
}

// Maps in the order of their keys.
void append_canonical(std::string& bytes, const google::protobuf::Message& message) {
  google::protobuf::io::StringOutputStream sink(&bytes);
  google::protobuf::io::CodedOutputStream stream(&sink);
  stream.SetSerializationDeterministic(true);
  LFD_CHECK(message.SerializeToCodedStream(&stream), "a part of a state can be serialised");
  stream.Trim();
}

}  // namespace

void StateHasher::ItemHashes::resize(std::size_t count) {
  hashes_.assign(count, {});
  sum_ = {};
}

void StateHasher::ItemHashes::set(std::size_t index, const Hash128& hash) {
  Hash128& known = hashes_.at(index);
  sum_.high += hash.high - known.high;
  sum_.low += hash.low - known.low;
  known = hash;
}

StateHasher::StateHasher(const proto::State& state) {
  take_scene(state);
  if (state.has_roi()) roi_ = hash_of(state.roi());
  if (state.has_render()) render_ = hash_of(state.render());
  buffers_ = state.buffers();
}

void StateHasher::updated(const proto::State& state, const proto::Update& update) {
  if (update.has_scene()) {
    take_scene(state);
  } else {
    for (const proto::MovedInstance& moved : update.moved_instance())
      instances_.set(moved.index(), hash_of(state.scene().instance(static_cast<int>(moved.index())), moved.index()));
    for (const proto::MovedLight& moved : update.moved_light())
      lights_.set(moved.index(), hash_of(state.scene().light(static_cast<int>(moved.index())), moved.index()));
  }
  if (update.has_roi()) roi_ = hash_of(state.roi());
  if (update.has_render()) render_ = hash_of(state.render());
  buffers_ = state.buffers();
}

void StateHasher::take_scene(const proto::State& state) {
  const proto::Scene& scene = state.scene();
  instances_.resize(static_cast<std::size_t>(scene.instance_size()));
  lights_.resize(static_cast<std::size_t>(scene.light_size()));
  for (std::size_t i = 0; i < instances_.count(); ++i)
    instances_.set(i, hash_of(scene.instance(static_cast<int>(i)), i));
  for (std::size_t i = 0; i < lights_.count(); ++i) lights_.set(i, hash_of(scene.light(static_cast<int>(i)), i));
  // Whatever a scene comes to have is in its hash.
  proto::Scene frame = scene;
  frame.clear_instance();
  frame.clear_light();
  frame_ = state.has_scene() ? hash_of(frame) : Hash128();
}

Hash128 StateHasher::hash_of(const google::protobuf::Message& part, std::uint64_t index) {
  std::string bytes;
  append(bytes, index);
  append_canonical(bytes, part);
  hashed_bytes_ += bytes.size();
  return hash_128(bytes);
}

std::string StateHasher::hash() const {
  std::string bytes;
  append(bytes, frame_);
  for (const ItemHashes* items : {&instances_, &lights_}) {
    append(bytes, items->count());
    append(bytes, items->sum());
  }
  append(bytes, roi_);
  append(bytes, render_);
  append(bytes, buffers_);
  return content_hash(bytes);
}

}  // namespace lfd
