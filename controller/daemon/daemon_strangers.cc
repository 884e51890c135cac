// What is asked of whoever wants something of the controller before it is given anything.
#include <algorithm>
#include <cctype>

#include "base/log.h"
#include "controller/daemon/daemon.h"
#include "controller/rights.h"
#include "proto/deployment_keys.h"
#include "proto/endpoint.h"

namespace lfd::controller {
namespace {

constexpr std::size_t kMostLetters = 64;  // of a peer's name, version and calibration hash

bool is_plain(const std::string& word) {
  return word.size() <= kMostLetters &&
         std::ranges::all_of(word, [](unsigned char c) { return c < 128 && std::isprint(c) != 0; });
}

// Words stand in logs and statuses, addresses are passed on to nodes: all must be what they seem.
Status check_words(const proto::Join& join, const Deployment& deployment) {
  if (!is_plain(join.name()) || !is_plain(join.version()) || !is_plain(join.calibration_hash()))
    return Error(fmt::format("its name, version or hash has other signs than letters, or more than {}", kMostLetters));
  if (join.role() != proto::DISPLAY || join.images_endpoint().empty()) return {};
  if (const Status endpoint = validate_endpoint(join.images_endpoint()); !endpoint)
    return endpoint.error().within("images");
  if (const Status reach = check_endpoint(deployment, join.images_endpoint()); !reach)
    return reach.error().within("images");
  return {};
}

const AllowList* allow_list(const wire::Context& context) {
  return context.keys() == nullptr ? nullptr : &context.keys()->allowed;
}

}  // namespace

bool Daemon::lets_join(const wire::Message& message, Clock::time_point now) {
  const proto::Join& join = message.envelope.join();
  if (!limiter_.admits(message.user.empty() ? message.peer : message.user, now)) {
    if (limiter_.warns(now))
      log::warn("too many joins and requests for the state; {} so far are passed over", limiter_.passed_over());
    if (limiter_.tells(message.peer, now)) {
      proto::Refused later;
      later.set_reason("too many want to join");
      later.set_try_again_ms(static_cast<std::uint32_t>(JoinLimiter::kTellPause.count()));
      refuse(message.peer, std::move(later));
    }
    return false;
  }
  Status may = check_words(join, options_.deployment);
  if (may) may = may_join(allow_list(*context_), message.user, join);
  if (may) return !seems_repeated(message, now);
  refuse_join(message, may.error(), now);
  return false;
}

// The log tells of some of them only, and the status of none under the name of a peer that lives: neither is a place
// for strangers to write in.
void Daemon::refuse_join(const wire::Message& message, const Error& why, Clock::time_point now) {
  const proto::Join& join = message.envelope.join();
  const std::string& name = join.name();
  if (refused_joins_.due(now)) {
    const std::string of =
        message.user.empty() || message.user == name ? "" : fmt::format(" with the key of \"{}\"", message.user);
    log::warn("\"{}\" (process {}){} is refused: {}", name.substr(0, kMostLetters), join.process(), of, why.message());
  }
  const Peer* known = members_.find(name);
  if (known != nullptr && !known->lives()) {
    stats_.join_refused(name, why.message());
  } else {
    stats_.refused();
  }
  proto::Refused refused;
  refused.set_reason(why.message());
  refuse(message.peer, std::move(refused));
}

// A process that joins anew has lost its connection, and is silent there. Where it is not, somebody says again what it
// said once.
bool Daemon::seems_repeated(const wire::Message& message, Clock::time_point now) {
  const proto::Join& join = message.envelope.join();
  const Peer* peer = members_.find(join.name());
  if (peer == nullptr || !peer->lives() || peer->address == message.peer || peer->process != join.process())
    return false;
  const auto doubt = Membership::kHeartbeatsOfDoubt * options_.deployment.pacing.heartbeat;
  if (!peer->last_heard || now - *peer->last_heard >= doubt) return false;
  const bool still_there = static_cast<bool>(links_.control.send_to(peer->address, proto::Envelope()));
  if (still_there) log::debug("\"{}\" joins from another place, and is heard where it was", peer->name);
  return still_there;
}

// It is the key that says who speaks. Nothing is answered: the answer would go to whoever calls itself so by then.
bool Daemon::borrows_address(const wire::Message& message, Clock::time_point now) {
  const Peer* owner = members_.other_at(message.peer, message.user);
  if (owner == nullptr) return false;
  stats_.refused();
  if (borrowed_.due(now))
    log::warn("a message from the address of \"{}\" is refused: it came with the key of \"{}\"", owner->name,
              message.user);
  return true;
}

Status Daemon::may_ask_for(const wire::Message& message, Clock::time_point now) {
  Status may = controller::may_ask(allow_list(*context_), message.user, message.envelope.request());
  if (!may && refusals_.due(now)) log::warn("a request is refused: {}", may.error().message());
  return may;
}

}  // namespace lfd::controller
