// A second host on this machine: a network namespace joined by a cable (veth), which a test may cut, spoil and narrow.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace lfd::harness {

// Needs root, iproute2 and, for some faults, nftables. The namespace and its cable go with the object.
class SecondHost {
 public:
  // The error says what the machine does not allow: a reason to skip.
  static Result<std::unique_ptr<SecondHost>> make();
  ~SecondHost();
  SecondHost(const SecondHost&) = delete;
  SecondHost& operator=(const SecondHost&) = delete;

  const std::string& here() const { return here_; }  // address of this end of the cable

  // What a program's command line begins with so that it runs there.
  std::vector<std::string> prefix() const;

  // Each an error where the machine does not allow it.
  Status cut();
  Status restore();
  Status lose_packets(int percent);    // at random, of those that come in there
  Status limit_bandwidth(int kbit_s);  // of what is sent from there
  Status clear();                      // loss and limits end

  // Packets that were lost on purpose, or had to wait for the limit, since that was set.
  Result<std::uint64_t> hindered_packets() const;

 private:
  SecondHost() = default;

  std::string name_, cable_here_, cable_there_, here_, there_;
};

}  // namespace lfd::harness
