// The distributed state: how updates change it and what its hash is; the same on both sides, so that hashes can be
// compared.
#pragma once

#include <string>

#include "base/result.h"
#include "proto/wire.pb.h"

namespace lfd {

// The hash of all of a state but its sequence. Who follows many updates keeps a StateHasher (proto/state_hasher.h).
std::string state_hash(const proto::State& state);

// Replaces the fields that `update` has, moves what it moves and takes its sequence. Errors, with `state` untouched:
// the update does not follow the state by one (ask for a snapshot), or it moves what the scene does not have, or to no
// place.
Status apply_update(proto::State& state, const proto::Update& update);

// Whether it moves something of a scene; whether assets may be needed that were not before.
bool moves(const proto::Update& update);
bool names_assets(const proto::Update& update);

// Equal field by field; unset fields equal only unset ones.
bool same_message(const google::protobuf::Message& a, const google::protobuf::Message& b);

// The same lists of materials; the same instances, materials and places included.
bool same_materials(const proto::Scene& a, const proto::Scene& b);
bool same_instances(const proto::Scene& a, const proto::Scene& b);

}  // namespace lfd
