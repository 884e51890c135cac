// Text for a terminal: a table that is drawn again and again in one place.
#pragma once

#include <string>
#include <string_view>

namespace lfd {

// The first `width` characters of every line, and the first `height` lines.
std::string cut_to(std::string_view text, int width, int height);

// Standard output, as a live table if it is a terminal: every text is shown in place of the one before, on a screen of
// its own without a cursor; both are given back with the object, and the last text stays. Elsewhere every text is
// printed, with an empty line behind it and no escape codes.
class LiveOutput {
 public:
  LiveOutput();
  ~LiveOutput();
  LiveOutput(const LiveOutput&) = delete;
  LiveOutput& operator=(const LiveOutput&) = delete;

  bool is_terminal() const { return is_terminal_; }

  // False where nobody can read it any more.
  bool show(const std::string& text);

 private:
  bool is_terminal_;
  std::string last_;
};

}  // namespace lfd
