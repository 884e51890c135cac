// Keys and reach.
#include "proto/deployment_keys.h"

#include <algorithm>
#include <charconv>

#include "base/log.h"

namespace lfd {
namespace {

// 127.0.0.1 and its like, in four numbers; "127.example.org" is a name.
bool is_loopback_number(std::string_view host) {
  if (!host.starts_with("127.") || std::ranges::count(host, '.') != 3) return false;
  return host.find_first_not_of("0123456789.") == host.npos;
}

}  // namespace

std::optional<std::filesystem::path> keys_folder(const Deployment& deployment) {
  const std::string& keys = deployment.message.security().keys();
  if (keys.empty()) return std::nullopt;
  return deployment.folder / keys;
}

Result<std::string> choose_key_file(const Deployment& deployment, const std::string& given, std::string_view name) {
  const auto folder = keys_folder(deployment);
  if (!folder && !given.empty()) return Error("--key: the deployment works without keys: it has no security { keys }");
  if (!folder) return std::string();
  return given.empty() ? (*folder / fmt::format("{}{}", name, kKeySuffix)).string() : given;
}

Status check_key_holder(const std::string& key_file, Right right, std::string_view name) {
  if (key_file.empty()) return {};
  LFD_TRY(const KeyRing keys, read_key_ring(key_file));
  const Allowed* const holder = keys.allowed.with_key(keys.own.public_key());
  if (holder == nullptr) {
    if (right != proto::Allowed::CONTROLLER) return {};
    return Error(fmt::format("{}: the key is not in {}, and nobody would talk to it", key_file, kAllowFile));
  }
  if (!holder->has(right))
    return Error(fmt::format("{}: the key of \"{}\" has no right {}", key_file, holder->name,
                             proto::Allowed::Right_Name(right)));
  if (name.empty() || holder->name == name) return {};
  return Error(fmt::format("{}: the key of \"{}\" is not that of \"{}\"", key_file, holder->name, name));
}

bool is_local_endpoint(std::string_view endpoint) {
  constexpr std::string_view kTcp = "tcp://";
  if (!endpoint.starts_with(kTcp)) return true;
  const std::string_view place = endpoint.substr(kTcp.size());
  const std::string_view host = place.substr(0, place.rfind(':'));
  return is_loopback_number(host) || host == "localhost" || host == "[::1]";
}

Status check_endpoint(const Deployment& deployment, std::string_view endpoint) {
  const auto& security = deployment.message.security();
  return check_endpoint(endpoint, !security.keys().empty(), security.accept_plain_tcp_beyond_loopback(), kKeysRemedy);
}

Status check_endpoint(std::string_view endpoint, bool has_key, bool accept_plain, const char* remedy) {
  if (has_key || accept_plain || is_local_endpoint(endpoint)) return {};
  return Error(fmt::format("\"{}\": plain tcp beyond this machine is refused: {}", endpoint, remedy));
}

}  // namespace lfd
