// Addresses and streams of a deployment file.
#include <map>
#include <tuple>

#include "base/log.h"
#include "proto/deployment_checks.h"
#include "proto/deployment_keys.h"
#include "proto/endpoint.h"

namespace lfd::deployment {
namespace {

bool has_wildcard(std::string_view endpoint) {
  return endpoint.starts_with("tcp://*:") || endpoint.starts_with("tcp://0.0.0.0:") ||
         endpoint.starts_with("tcp://[::]:");
}

// Plain tcp that others reach is an error of the file, unless it says so.
Check check_reach(const proto::Deployment::Security& m, const std::string& road, const std::string& endpoint) {
  const auto reach = check_endpoint(endpoint, !m.keys().empty(), m.accept_plain_tcp_beyond_loopback(), kKeysRemedy);
  if (reach) return std::nullopt;
  return Fault{
      road,
      Error(reach.error().message() + ", or say security { accept_plain_tcp_beyond_loopback: true }").within(road)};
}

}  // namespace

Check read_addresses(const proto::Deployment& deployment, Addresses& addresses) {
  const proto::Deployment::Addresses& m = deployment.addresses();
  const proto::Deployment::Security& security = deployment.security();
  if (!security.keys().empty() && security.accept_plain_tcp_beyond_loopback()) {
    const std::string road = "security: accept_plain_tcp_beyond_loopback";
    return Fault{road, Error(road + ": with keys nothing is plain: one of the two")};
  }
  std::map<std::string, std::string> seen;
  for (const auto& [field, text, address] :
       {std::tuple{"control", &m.control(), &addresses.control}, std::tuple{"state", &m.state(), &addresses.state},
        std::tuple{"bulk", &m.bulk(), &addresses.bulk}, std::tuple{"images", &m.images(), &addresses.images}}) {
    if (text->empty()) continue;
    const std::string road = fmt::format("addresses: {}", field);
    if (auto status = validate_endpoint(*text); !status) return Fault{road, status.error().within(road)};
    if (has_wildcard(*text)) {
      return Fault{road,
                   Error(fmt::format("{}: \"{}\": peers are told this address: name one interface", road, *text))};
    }
    if (auto status = validate_bound_endpoint(*text); !status) return Fault{road, status.error().within(road)};
    if (is_fixed_endpoint(*text) && !seen.emplace(*text, field).second) {
      return Fault{road, Error(fmt::format("{}: \"{}\" is the address of {} already", road, *text, seen[*text]))};
    }
    if (auto fault = check_reach(security, road, *text)) return fault;
    *address = *text;
  }
  if (is_local_endpoint(addresses.control)) return std::nullopt;
  for (const auto& [field, address] :
       {std::pair{"state", &addresses.state}, {"bulk", &addresses.bulk}, {"images", &addresses.images}}) {
    if (!is_local_endpoint(*address)) continue;
    return Fault{"addresses",
                 Error(fmt::format("addresses: {}: \"{}\" cannot be reached from other machines, as control can", field,
                                   *address))};
  }
  return std::nullopt;
}

Check read_stream(const proto::Stream& m) {
  if (m.codec() < proto::RAW_IMAGES || m.codec() > proto::JPEG_IMAGES)
    return Fault{"stream: codec", Error("stream: codec: must be RAW_IMAGES, ZSTD_IMAGES or JPEG_IMAGES")};
  if (m.has_level()) {
    if (auto fault = check_range("stream: level", m.level(), 1, 19)) return fault;
  }
  if (m.has_quality()) {
    if (auto fault = check_range("stream: quality", m.quality(), 1, 100)) return fault;
  }
  constexpr double kMost_mib = 65536, kMostAssets_mib = 64;  // as many pieces as wait in the queue of a link
  if (auto fault = check_range("stream: waiting_mib", m.waiting_mib(), 0, kMost_mib)) return fault;
  return check_range("stream: assets_mib", m.assets_mib(), 0, kMostAssets_mib);
}

}  // namespace lfd::deployment
