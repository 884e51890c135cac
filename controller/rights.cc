// Members and their rights.
#include "controller/rights.h"

#include "base/log.h"

namespace lfd::controller {
namespace {

bool has(const AllowList& allowed, const std::string& user, Right right) {
  const Allowed* member = allowed.named(user);
  return member != nullptr && member->has(right);
}

Error missing(const std::string& user, Right right) {
  return Error(fmt::format("the key of \"{}\" has no right {}", user, proto::Allowed::Right_Name(right)));
}

}  // namespace

Status may_join(const AllowList* allowed, const std::string& user, const proto::Join& join) {
  if (allowed == nullptr) return {};
  const Right needed = join.role() == proto::NODE ? proto::Allowed::NODE : proto::Allowed::DISPLAY;
  if (!has(*allowed, user, needed)) return missing(user, needed);
  if (join.role() == proto::NODE && join.name() != user)
    return Error(fmt::format("the key of \"{}\" is not that of node \"{}\"", user, join.name()));
  return {};
}

Status may_ask(const AllowList* allowed, const std::string& user, const proto::Request& request) {
  if (allowed == nullptr || has(*allowed, user, proto::Allowed::CONTROL)) return {};
  const bool looks = request.has_status() || request.has_follow();
  if (looks && has(*allowed, user, proto::Allowed::STATUS)) return {};
  return missing(user, looks ? proto::Allowed::STATUS : proto::Allowed::CONTROL);
}

}  // namespace lfd::controller
