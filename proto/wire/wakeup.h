// A bell between threads that a waiting thread hears beside its sockets (an eventfd).
#pragma once

namespace lfd::wire {

class Wakeup {
 public:
  Wakeup();
  ~Wakeup();
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;

  void ring() const;  // from any thread, also from a signal handler; the descriptor stays readable until silence()
  void silence() const;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace lfd::wire
