// Requests in, answers out, at the place where the library looks for them.
#include "proto/wire/zap_handler.h"

#include <cerrno>

#include "base/check.h"
#include "base/log.h"
#include "base/now_and_then.h"
#include "proto/wire/zap.h"

namespace lfd::wire {
namespace {

constexpr const char* kPlace = "inproc://zeromq.zap.01";

// Strangers decide how often there is something to say: at most one line now and then.
class Refusals {
 public:
  void add(const std::string& refusal) {
    ++count_;
    if (!pause_.due(Clock::now())) return;
    log::warn("not let in: {} (so far {} times)", refusal, count_);
  }

 private:
  std::uint64_t count_ = 0;
  NowAndThen pause_;
};

void answer_one(zmq::socket_t& requests, const AllowList& allowed, Refusals& refusals) {
  std::vector<std::string> frames;
  zmq::message_t frame;
  do {
    if (!requests.recv(frame, zmq::recv_flags::dontwait)) return;
    frames.push_back(frame.to_string());
  } while (frame.more());
  const ZapAnswer answer = answer_zap(frames, allowed);
  if (!answer.refusal.empty()) refusals.add(answer.refusal);
  for (std::size_t i = 0; i < answer.frames.size(); ++i) {
    const bool more = i + 1 < answer.frames.size();
    requests.send(zmq::buffer(answer.frames[i]), more ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }
}

}  // namespace

ZapHandler::ZapHandler(zmq::context_t& context, AllowList allowed) : allowed_(std::move(allowed)) {
  zmq::socket_t requests(context, zmq::socket_type::rep);
  requests.set(zmq::sockopt::linger, 0);
  requests.bind(kPlace);
  thread_ = std::thread([this, socket = std::move(requests)]() mutable { answer_until_stopped(std::move(socket)); });
}

ZapHandler::~ZapHandler() {
  stop_.ring();
  thread_.join();
}

void ZapHandler::answer_until_stopped(zmq::socket_t requests) const {
  Refusals refusals;
  while (true) {
    zmq::pollitem_t items[] = {{requests.handle(), 0, ZMQ_POLLIN, 0}, {nullptr, stop_.descriptor(), ZMQ_POLLIN, 0}};
    try {
      zmq::poll(items, std::size(items), std::chrono::milliseconds(-1));
      if ((items[1].revents & ZMQ_POLLIN) != 0) return;
      if ((items[0].revents & ZMQ_POLLIN) != 0) answer_one(requests, allowed_, refusals);
    } catch (const zmq::error_t& error) {
      LFD_CHECK(error.num() == EINTR, error.what());
    }
  }
}

}  // namespace lfd::wire
