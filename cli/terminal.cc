// ANSI escape codes.
#include "cli/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

namespace lfd {
namespace {

constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l";  // another screen, no cursor
constexpr std::string_view kLeave = "\x1b[?25h\x1b[?1049l";
constexpr std::string_view kHome = "\x1b[H", kClearLine = "\x1b[K", kClearBelow = "\x1b[J";

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }  // of UTF-8

}  // namespace

std::string cut_to(std::string_view text, int width, int height) {
  std::string out;
  int column = 0, line = 0;
  for (const char c : text) {
    if (line >= height) break;
    if (c == '\n') {
      out += c;
      column = 0;
      ++line;
      continue;
    }
    if (!is_continuation(c)) ++column;
    if (column <= width) out += c;
  }
  return out;
}

LiveOutput::LiveOutput() : is_terminal_(::isatty(STDOUT_FILENO) == 1) {
  if (is_terminal_) std::cout << kEnter << std::flush;
}

LiveOutput::~LiveOutput() {
  if (is_terminal_) std::cout << kLeave << last_ << std::flush;
}

bool LiveOutput::show(const std::string& text) {
  if (!is_terminal_) {
    std::cout << text << "\n" << std::flush;
    return static_cast<bool>(std::cout);
  }
  last_ = text;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    size = {.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
  std::string drawn(kHome);
  for (const char c : cut_to(text, size.ws_col, size.ws_row - 1)) {
    if (c == '\n') drawn += kClearLine;
    drawn += c;
  }
  std::cout << drawn << kClearBelow << std::flush;
  return static_cast<bool>(std::cout);
}

}  // namespace lfd
