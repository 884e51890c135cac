// The distributed state: how updates change it and what its hash is; the same on both sides, so that hashes can be
// compared.
#pragma once

#include <string>

#include "base/result.h"
#include "proto/wire.pb.h"

namespace lfd {

// content_hash of the state's canonical bytes: its deterministic serialisation with the sequence left out.
std::string state_hash(const proto::State& state);

// Replaces the fields that `update` has and takes its sequence. Errors, with `state` untouched: the update does not
// follow the state by one (ask for a snapshot), or it places another number of instances than the scene has.
Status apply_update(proto::State& state, const proto::Update& update);

// Equal field by field; unset fields equal only unset ones.
bool same_message(const google::protobuf::Message& a, const google::protobuf::Message& b);

// The same lists of materials; the same instances, materials and places included.
bool same_materials(const proto::Scene& a, const proto::Scene& b);
bool same_instances(const proto::Scene& a, const proto::Scene& b);

}  // namespace lfd
