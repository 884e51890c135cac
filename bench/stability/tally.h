// What became of the bad values of one field: refused by name, or harmless.
#pragma once

#include <string>
#include <vector>

#include "bench/stability/case.h"

namespace lfd::bench {

inline constexpr const char* kEachRefusedOrHarmless = "each value refused with the field's name, or harmless";

class Tally {
 public:
  // words: one of them must stand in every error, as a word of its own.
  explicit Tally(std::vector<std::string> words) : words_(std::move(words)) {}

  void refused(const std::string& value, const std::string& message);
  // harm: empty, or what is wrong with what was accepted.
  void accepted(const std::string& value, const std::string& harm);

  // Passes where there was no fault and at least one value.
  Outcome outcome() const;

 private:
  void fault(const std::string& value, const std::string& what);

  std::vector<std::string> words_;
  int refused_ = 0, accepted_ = 0;
  std::string fault_;
};

}  // namespace lfd::bench
