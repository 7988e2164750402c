#include "terminal/text_style.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace tactile_net::tool {
namespace {

constexpr std::size_t narrowest = 40;
constexpr std::size_t widest = 100;

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : value;
}

std::size_t width_of(int descriptor) {
  winsize size{};
  if (::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  const std::string_view columns = environment("COLUMNS");
  std::size_t width = 0;
  std::from_chars(columns.data(), columns.data() + columns.size(), width);
  return width > 0 ? width : TextStyle{}.width;
}

/// The word that begins `text`: up to a blank, or behind the comma of a list in braces.
std::string_view first_word(std::string_view text, bool& in_braces) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ' ' || text[i] == '\n') return text.substr(0, i);
    if (text[i] == '{') in_braces = true;
    if (text[i] == '}') in_braces = false;
    if (text[i] == ',' && in_braces) return text.substr(0, i + 1);
  }
  return text;
}

}  // namespace

TextStyle style_of(int descriptor) {
  return {.width = std::clamp(width_of(descriptor), narrowest, widest),
          .bold = ::isatty(descriptor) == 1 && environment("NO_COLOR").empty() &&
                  environment("TERM") != "dumb"};
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent,
                    std::size_t first) {
  std::string lines;
  std::size_t column = first;
  std::size_t start = first;  // of the line: nothing stands there yet
  bool in_braces = false;
  std::size_t blanks = 0;
  const auto new_line = [&] {
    lines += '\n' + std::string(indent, ' ');
    column = start = indent;
  };
  while (!text.empty()) {
    if (text.front() == '\n') {
      new_line();
      blanks = 0;
      text.remove_prefix(1);
    } else if (text.front() == ' ') {
      ++blanks;
      text.remove_prefix(1);
    } else {
      const std::string_view word = first_word(text, in_braces);
      if (column > start && column + blanks + word.size() > width)
        new_line();
      else
        lines.append(blanks, ' '), column += blanks;
      lines += word;
      column += word.size();
      blanks = 0;
      text.remove_prefix(word.size());
    }
  }
  return lines;
}

}  // namespace tactile_net::tool
