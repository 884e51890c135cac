// One field's cases.
#include "bench/stability/file_fields.h"

#include <algorithm>
#include <utility>

#include "base/log.h"
#include "bench/stability/tally.h"

namespace lfd::bench {
namespace {

Outcome spoil(const FileField& field) {
  // A file that is refused or does harm without the bad value would say nothing about it.
  const auto whole = field.read(field.sound);
  if (!whole) return {"the sound file is refused: " + whole.error().message(), 0, false};
  if (!whole->empty()) return {"the sound file does harm: " + *whole, 0, false};
  Tally tally(field.words, field.beginning);
  for (const std::string& value : field.bad) {
    const auto harm = field.read(value);
    harm ? tally.accepted(value, *harm) : tally.refused(value, harm.error().message());
  }
  return tally.outcome();
}

}  // namespace

int TextSlot::line() const { return 1 + static_cast<int>(std::ranges::count(head, '\n')); }

TextSlot slot_of(const std::string& text, std::string_view before, char end) {
  const std::size_t found = text.find(before);
  LFD_CHECK(found != text.npos, before);
  const std::size_t begin = found + before.size(), length = text.find(end, begin) - begin;
  return {text.substr(0, begin), text.substr(begin, length), text.substr(begin + length)};
}

StabilityCase field_case(std::string group, const FileField& field) {
  const char* note = field.beginning.find('#') == std::string::npos ? "" : " (#: any line)";
  return {std::move(group), field.name,
          fmt::format("each value refused by the field's name, the error beginning \"{}\"{}, or harmless",
                      field.beginning, note),
          [field](const gl::Context&) { return spoil(field); }};
}

}  // namespace lfd::bench
