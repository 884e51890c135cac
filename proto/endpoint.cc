// The syntax of endpoints.
#include "proto/endpoint.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string>

#include "base/log.h"

namespace lfd {
namespace {

constexpr std::string_view kTcp = "tcp://", kIpc = "ipc://";
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_";

bool is_host(std::string_view host) {
  if (host == "*") return true;
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') {
    return host.substr(1, host.size() - 2).find_first_not_of("0123456789abcdefABCDEF:.%") == host.npos;
  }
  return !host.empty() && host.find_first_not_of(kLetters) == host.npos;
}

bool is_digit(unsigned char c) { return c < 128 && std::isdigit(c) != 0; }

// As Linux names them: at most 15 letters; a dot stands before the number of a virtual network (eth0.100) alone.
bool may_be_interface(std::string_view host) {
  constexpr std::size_t kMostLetters = 15;
  if (host.size() > kMostLetters || host.front() == '[' || host == "localhost") return false;
  const std::size_t dot = std::min(host.find('.'), host.size());
  const std::string_view name = host.substr(0, dot), network = host.substr(std::min(dot + 1, host.size()));
  const bool is_named = !std::ranges::all_of(name, is_digit);
  return is_named && std::ranges::all_of(network, is_digit) && dot + 1 != host.size();
}

bool is_port(std::string_view port) {
  if (port == "*") return true;
  int number = 0;
  const auto [end, failure] = std::from_chars(port.data(), port.data() + port.size(), number);
  return failure == std::errc() && end == port.data() + port.size() && number >= 1 && number <= 65535;
}

}  // namespace

Status validate_endpoint(std::string_view endpoint) {
  if (endpoint.starts_with(kIpc)) {
    const std::size_t length = endpoint.size() - kIpc.size();
    if (length >= 1 && length <= 107 && endpoint.find('\0') == endpoint.npos) return {};
    return Error(fmt::format("\"{}\": the path of an ipc endpoint has 1 to 107 bytes", endpoint));
  }
  if (!endpoint.starts_with(kTcp)) return Error(fmt::format("\"{}\": must be tcp://host:port or ipc://path", endpoint));
  const std::string_view place = endpoint.substr(kTcp.size());
  const std::size_t colon = place.rfind(':');
  if (colon == place.npos) return Error(fmt::format("\"{}\": has no port", endpoint));
  if (!is_host(place.substr(0, colon))) return Error(fmt::format("\"{}\": this is no host", endpoint));
  if (!is_port(place.substr(colon + 1)))
    return Error(fmt::format("\"{}\": the port must be 1 to 65535, or *", endpoint));
  return {};
}

Status validate_bound_endpoint(std::string_view endpoint) {
  if (!endpoint.starts_with(kTcp)) return {};
  const std::string_view place = endpoint.substr(kTcp.size());
  const std::string host(place.substr(0, place.rfind(':')));
  in_addr number{};
  if (host == "*" || ::inet_aton(host.c_str(), &number) != 0 || may_be_interface(host)) return {};
  return Error(fmt::format(
      "\"{}\": neither names nor IPv6 can be listened at: a numeric IPv4 address or an interface is needed", endpoint));
}

bool is_fixed_endpoint(std::string_view endpoint) { return !endpoint.empty() && !endpoint.ends_with(":*"); }

}  // namespace lfd
