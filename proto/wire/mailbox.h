// A small bounded queue between two threads, whose receiver may wait on sockets at the same time.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

#include "base/clock.h"
#include "proto/wire/wakeup.h"

namespace lfd::wire {

// Any thread may put and take. descriptor() is readable exactly while something can be taken or the mailbox is closed.
template <class T>
class Mailbox {
 public:
  explicit Mailbox(std::size_t capacity) : capacity_(capacity) {}

  // False, and `item` is untouched, where the mailbox is full or closed.
  bool put(T&& item) {
    const std::lock_guard lock(mutex_);
    if (closed_ || items_.size() >= capacity_) return false;
    items_.push_back(std::move(item));
    bell_.ring();
    arrived_.notify_one();
    return true;
  }

  // The oldest item, if there is one; items put before close() can still be taken.
  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    return take_locked();
  }

  // Waits for an item; absent after `at_most`, or at once where the mailbox is closed and empty.
  std::optional<T> take_within(Clock::duration at_most) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, at_most, [this] { return closed_ || !items_.empty(); });
    return take_locked();
  }

  // Nothing can be put any more; whoever waits wakes up.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    bell_.ring();
    arrived_.notify_all();
  }

  bool closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
  }
  int descriptor() const { return bell_.descriptor(); }

 private:
  std::optional<T> take_locked() {
    if (items_.empty()) return std::nullopt;
    std::optional<T> item(std::move(items_.front()));
    items_.pop_front();
    if (items_.empty() && !closed_) bell_.silence();
    return item;
  }

  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<T> items_;
  bool closed_ = false;
  Wakeup bell_;
};

}  // namespace lfd::wire
