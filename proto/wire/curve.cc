// zmq_curve_keypair and zmq_curve_public.
#include "proto/wire/curve.h"

#include <zmq.h>

#include <array>

#include "base/log.h"

namespace lfd::wire {
namespace {

constexpr std::size_t kKeyBytes = 32;
using Letters = std::array<char, 41>;  // of Z85, with the zero at their end

Status check_library() {
  return ::zmq_has("curve") != 0 ? Status() : Error("the message library (libzmq) was built without CURVE");
}

}  // namespace

Result<proto::KeyFile> make_key(const std::string& name) {
  LFD_TRY_STATUS(check_library());
  Letters public_key{}, secret_key{};
  if (::zmq_curve_keypair(public_key.data(), secret_key.data()) != 0)
    return Error(fmt::format("no key pair can be made: {}", ::zmq_strerror(::zmq_errno())));
  proto::KeyFile key;
  key.set_name(name);
  key.set_public_key(public_key.data());
  key.set_secret_key(secret_key.data());
  return key;
}

Status check_pair(const proto::KeyFile& key) {
  LFD_TRY_STATUS(check_library());
  Letters public_key{};
  const bool fits = ::zmq_curve_public(public_key.data(), key.secret_key().c_str()) == 0;
  if (fits && key.public_key() == public_key.data()) return {};
  return Error(fmt::format("key \"{}\": public_key is not that of secret_key", key.name()));
}

std::string z85_of(std::string_view bytes) {
  if (bytes.size() != kKeyBytes) return "";
  Letters letters{};
  ::zmq_z85_encode(letters.data(), reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  return letters.data();
}

}  // namespace lfd::wire
