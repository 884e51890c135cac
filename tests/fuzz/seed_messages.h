// Real messages, from which the fuzzers of messages begin.
#pragma once

#include <string>
#include <vector>

#include "proto/wire.pb.h"

namespace lfd::fuzz {

struct Step {
  std::string name;
  proto::Envelope envelope;
  std::string payload = {};
  int sender = 0;
  int wait = 0;
};

// Each kind of message once, as a member sends it.
std::vector<Step> steps();

}  // namespace lfd::fuzz
