// A render node without a renderer, in the test's own process: it joins, gathers assets, follows the state and says
// drawn and ready.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/version.h"
#include "proto/wire/socket.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {

class PlayedNode {
 public:
  // What the node does when it should; faults are the absence of some of it.
  struct Habits {
    proto::Role role = proto::NODE;
    std::string version = kVersion;
    std::string calibration_hash = Workbench::display_hash();
    std::string images_endpoint = {};  // of a display
    std::uint64_t process = 1;
    bool beats = true;             // heartbeats
    bool draws = true;             // answers begin with drawn and ready
    bool prepares = true;          // says at once that it has prepared a scene that is to come
    bool shows = false;            // a display: answers swap with shown
    bool drops = false;            // instead: the frame was dropped
    std::string error = {};        // with which it cannot draw; empty: it can
    std::string drawn_hash = {};   // of the state that it says it draws; empty: of its own
    std::size_t report_bytes = 0;  // its reports are at least so long
    std::string key_file = {};     // empty: without keys
  };

  PlayedNode(std::string name, const std::string& endpoint) : PlayedNode(std::move(name), endpoint, Habits()) {}
  PlayedNode(std::string name, const std::string& endpoint, Habits habits);

  // Takes in what has arrived and does what is to be done; never waits.
  void step();

  Habits habits;  // may be changed at any time

  // What it has seen so far.
  std::optional<std::string> refusal;
  std::optional<proto::Welcome> welcome;
  proto::State state;
  std::map<std::string, std::string> assets;  // bytes by hash, complete ones only
  std::vector<std::uint64_t> begun;           // frames, in the order of their begins
  std::vector<std::uint64_t> named;           // those of them that it was named for
  std::optional<proto::Prepare> prepare;      // the last one
  std::vector<std::uint32_t> assigned;        // the modules of its last Assign
  std::vector<proto::SwapFrame> swaps;
  bool quit = false;

  std::string state_hash() const;  // empty while it does not hold all of the state
  bool holds_state() const { return !state_hash().empty(); }
  void leave();
  // Answers the last Prepare.
  void say_prepared(const std::string& error);

  // The sockets, for waiting.
  std::vector<const wire::Socket*> sockets() const;

 private:
  void join_or_beat();
  void take_control(const proto::Envelope& envelope);
  void take_state(const proto::Envelope& envelope);
  void take_chunk(const wire::Message& message);
  void take_snapshot(const proto::Snapshot& snapshot);
  void want_next_asset();
  void answer(std::uint64_t frame);
  void send(const proto::Envelope& envelope);

  std::string name_;
  std::unique_ptr<wire::Context> context_;
  wire::Socket control_;
  std::optional<wire::Socket> state_socket_, bulk_;
  std::map<std::string, std::string> partial_;
  Clock::time_point next_words_{};
  std::uint64_t share_ = 0;
  bool hears_state_ = false;  // the subscription is known to have arrived
  std::optional<std::string> wanted_;
};

// Steps all nodes until `done` or `at_most` has passed; whether it was done. Waits on the sockets in between.
bool play_until(std::initializer_list<PlayedNode*> nodes, const std::function<bool()>& done,
                Clock::duration at_most = std::chrono::seconds(20));

}  // namespace lfd::harness
