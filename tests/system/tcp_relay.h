// A wire between two processes that a test can cut: bytes pass through unchanged, connections end when they are told
// to.
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "proto/wire/wakeup.h"

namespace lfd::harness {

class TcpRelay {
 public:
  // Connects whoever connects to endpoint() with that endpoint of the loopback interface ("tcp://127.0.0.1:PORT").
  explicit TcpRelay(const std::string& target);
  ~TcpRelay();
  TcpRelay(const TcpRelay&) = delete;
  TcpRelay& operator=(const TcpRelay&) = delete;

  std::string endpoint() const;

  // Ends all connections there are, with what is on its way. New ones are made at once.
  void cut();
  int cuts() const { return cuts_; }  // of connections

 private:
  void run();
  void accept_one();
  void end_all();

  int port_, target_port_, listener_;
  std::vector<std::pair<int, int>> links_;  // of run()
  wire::Wakeup bell_;
  std::atomic<bool> ends_{false}, cuts_now_{false};
  std::atomic<int> cuts_{0};
  std::thread thread_;
};

// Of a process, as /proc says; 0 where there is none.
std::size_t resident_bytes(int process);

}  // namespace lfd::harness
