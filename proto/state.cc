// Updates and hash of the distributed state.
#include "proto/state.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/message_differencer.h>

#include <algorithm>

#include "base/hash.h"
#include "base/log.h"

namespace lfd {
namespace {

std::string canonical_bytes(const proto::State& state) {
  std::string bytes;
  google::protobuf::io::StringOutputStream sink(&bytes);
  google::protobuf::io::CodedOutputStream stream(&sink);
  stream.SetSerializationDeterministic(true);
  LFD_CHECK(state.SerializeToCodedStream(&stream), "a state can be serialised");
  stream.Trim();
  return bytes;
}

}  // namespace

std::string state_hash(const proto::State& state) {
  if (state.sequence() == 0) return content_hash(canonical_bytes(state));
  proto::State unnumbered = state;
  unnumbered.clear_sequence();
  return content_hash(canonical_bytes(unnumbered));
}

Status apply_update(proto::State& state, const proto::Update& update) {
  if (update.sequence() != state.sequence() + 1) {
    return Error(fmt::format("update {} does not follow state {}", update.sequence(), state.sequence()));
  }
  const proto::Scene& scene = update.has_scene() ? update.scene() : state.scene();
  if (update.instance_size() > 0 && update.instance_size() != scene.instance_size()) {
    return Error(fmt::format("update {} places {} instances; the scene has {}", update.sequence(),
                             update.instance_size(), scene.instance_size()));
  }
  if (update.has_scene()) *state.mutable_scene() = update.scene();
  if (update.has_roi()) *state.mutable_roi() = update.roi();
  if (update.has_render()) *state.mutable_render() = update.render();
  if (update.has_buffers()) state.set_buffers(update.buffers());
  if (update.instance_size() > 0) *state.mutable_scene()->mutable_instance() = update.instance();
  state.set_sequence(update.sequence());
  return {};
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
