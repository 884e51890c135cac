// Key pairs of CURVE, the mechanism by which ZeroMQ encrypts and tells who speaks.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "proto/keys.pb.h"

namespace lfd::wire {

// A new pair. Error: the message library was built without CURVE.
Result<proto::KeyFile> make_key(const std::string& name);

// Whether the public key is that of the secret one.
Status check_pair(const proto::KeyFile& key);

// 32 bytes as 40 letters; empty for any other number.
std::string z85_of(std::string_view bytes);

}  // namespace lfd::wire
