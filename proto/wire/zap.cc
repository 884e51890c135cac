// Requests of RFC 27.
#include "proto/wire/zap.h"

#include "base/log.h"
#include "proto/wire/curve.h"

namespace lfd::wire {
namespace {

constexpr std::string_view kVersion = "1.0";
constexpr std::size_t kAddress = 3, kMechanism = 5, kCredentials = 6, kFrames = 7;

// Why the member is not let in; empty: it is.
std::string judge(const Allowed& member, std::string_view domain) {
  using proto::Allowed;
  if (domain == zap_domain(Listener::kController)) {
    for (const Right right : {Allowed::NODE, Allowed::DISPLAY, Allowed::CONTROL, Allowed::STATUS}) {
      if (member.has(right)) return "";
    }
  }
  if (domain == zap_domain(Listener::kDisplay) && member.has(Allowed::NODE)) return "";
  return fmt::format("the key of \"{}\" (right {}) opens nothing here", member.name, rights_text(member));
}

}  // namespace

const char* zap_domain(Listener listener) { return listener == Listener::kController ? "controller" : "display"; }

ZapAnswer answer_zap(const std::vector<std::string>& request, const AllowList& allowed) {
  const auto field = [&](std::size_t i) { return i < request.size() ? request[i] : std::string(); };
  const Allowed* member = nullptr;
  std::string refusal;
  if (request.size() != kFrames || field(0) != kVersion || field(kMechanism) != "CURVE") {
    refusal = "this is no request to let a CURVE key in";
  } else if ((member = allowed.with_key(z85_of(field(kCredentials)))) == nullptr) {
    refusal = fmt::format("the key {} is not in {}", z85_of(field(kCredentials)), kAllowFile);
  } else {
    refusal = judge(*member, field(2));
  }
  const bool is_in = refusal.empty();
  ZapAnswer answer;
  answer.frames = {std::string(kVersion),     field(1), is_in ? "200" : "400", is_in ? "OK" : "refused",
                   is_in ? member->name : "", ""};
  if (!is_in) answer.refusal = fmt::format("{}: {}", field(kAddress), refusal);
  return answer;
}

}  // namespace lfd::wire
