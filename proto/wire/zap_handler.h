// The thread of a context with keys that is asked who may come in.
#pragma once

#include <thread>
#include <zmq.hpp>

#include "proto/key_files.h"
#include "proto/wire/wakeup.h"

namespace lfd::wire {

class ZapHandler {
 public:
  // From here to its end, sockets of the context have whom to ask.
  ZapHandler(zmq::context_t& context, AllowList allowed);
  ~ZapHandler();
  ZapHandler(const ZapHandler&) = delete;
  ZapHandler& operator=(const ZapHandler&) = delete;

 private:
  void answer_until_stopped(zmq::socket_t requests) const;

  const AllowList allowed_;
  Wakeup stop_;
  std::thread thread_;
};

}  // namespace lfd::wire
