// What became of the bad values of one field: refused by name, or harmless.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/stability/case.h"

namespace lfd::bench {

inline constexpr const char* kEachRefusedOrHarmless = "each value refused with the field's name, or harmless";

class Tally {
 public:
  // words: one of them must stand in every error, as a word of its own. beginning: every error must begin with it; a
  // '#' in it stands for any whole number: "f.mpcdi: mpcdi.xml:#: ".
  explicit Tally(std::vector<std::string> words, std::string beginning = "")
      : words_(std::move(words)), beginning_(std::move(beginning)) {}

  void refused(const std::string& value, const std::string& message);
  // harm: empty, or what is wrong with what was accepted.
  void accepted(const std::string& value, const std::string& harm);

  // Passes where there was no fault and at least one value.
  Outcome outcome() const;

 private:
  void fault(const std::string& value, const std::string& what);

  std::vector<std::string> words_;
  std::string beginning_;
  int refused_ = 0, accepted_ = 0;
  std::string fault_;
};

}  // namespace lfd::bench
