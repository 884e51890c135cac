// Keys and reach.
#include "proto/deployment_keys.h"

#include <algorithm>
#include <charconv>

#include "base/log.h"
#include "proto/key_files.h"

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

bool is_local_endpoint(std::string_view endpoint) {
  constexpr std::string_view kTcp = "tcp://";
  if (!endpoint.starts_with(kTcp)) return true;
  const std::string_view place = endpoint.substr(kTcp.size());
  const std::string_view host = place.substr(0, place.rfind(':'));
  return is_loopback_number(host) || host == "localhost" || host == "[::1]";
}

Status check_endpoint(const Deployment& deployment, std::string_view endpoint) {
  const auto& security = deployment.message.security();
  return check_endpoint(endpoint, !security.keys().empty(), security.accept_plain_tcp_beyond_loopback());
}

Status check_endpoint(std::string_view endpoint, bool has_key, bool accept_plain) {
  if (has_key || accept_plain || is_local_endpoint(endpoint)) return {};
  return Error(
      fmt::format("\"{}\": plain tcp beyond this machine is refused: give the deployment keys (security {{ keys: "
                  "\"keys\" }} and `lfd keys make`)",
                  endpoint));
}

}  // namespace lfd
