// Fields of files that are not ours, spoilt value by value: each refused with its place and its name, or harmless.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/stability/case.h"

namespace lfd::bench {

// No numbers, numbers that fit nothing, and those at the edges of what a double holds.
inline constexpr std::array kBadTexts{"nan",
                                      "inf",
                                      "-inf",
                                      "1e309",
                                      "-1e309",
                                      "1e300",
                                      "-1e300",
                                      "1e39",
                                      "1e12",
                                      "-1e12",
                                      "1e-12",
                                      "1e-40",
                                      "4.9e-324",
                                      "1e-400",
                                      "0",
                                      "-0",
                                      "-1",
                                      "",
                                      "1e",
                                      "0x10",
                                      "1;5",
                                      "--1",
                                      "9999999999999999999"};

// The same for floats in binary files, as texts that std::strtof reads exactly.
inline constexpr std::array kBadFloats{"nan",  "inf",  "-inf",  "3e38",  "-3e38", "1e30", "1e12",
                                       "-1e5", "1e-7", "1e-30", "1e-44", "0",     "-0"};

// A value's place in a text.
struct TextSlot {
  std::string head, sound, tail;  // before the value, the value itself, after it

  std::string with(const std::string& value) const { return head + value + tail; }
  int line() const;  // from 1
};

// The value from behind the first `before` up to the next `end`.
TextSlot slot_of(const std::string& text, std::string_view before, char end);

struct FileField {
  std::string name;              // of the case
  std::string sound;             // a value that is right: the file with it must be accepted
  std::vector<std::string> bad;  // the values tried instead
  // What every error must say (bench/stability/tally.h).
  std::vector<std::string> words;
  std::string beginning;
  // Reads the file with `value` in it: the harm that what was accepted can do, or why it is refused.
  std::function<Result<std::string>(const std::string& value)> read;
};

StabilityCase field_case(std::string group, const FileField& field);

inline constexpr const char* kTextGroup = "fields of files of text";

}  // namespace lfd::bench
