// What a node or display does where the controller refuses it.
#pragma once

#include <string>

#include "base/clock.h"
#include "base/result.h"
#include "proto/wire.pb.h"

namespace lfd {

class Refusals {
 public:
  // Whether it is a member no longer, and has to join again now. Where it is to join later, it says so once and puts
  // `next_join` off, by no more than 10 s. Not a member, said to one that has asked to join by now, changes nothing: a
  // controller that was started anew answers every heartbeat of a peer it does not know, and the join that the first
  // answer brings about stands. Error, which begins with `controller`: it is refused for good, unless it is a member,
  // which asks once more.
  Result<bool> heard(const proto::Refused& refused, bool is_member, const std::string& controller,
                     Clock::time_point& next_join);

  // It has been let in.
  void welcomed() { waits_ = false; }

 private:
  bool waits_ = false;  // it was told to try again, and has said so
};

}  // namespace lfd
