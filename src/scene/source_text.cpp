#include "scene/source_text.hpp"

#include "scene/excerpt.hpp"

namespace tactile_net {

namespace {

constexpr int most_key_parts = 8;  // toml++ allows 256 nested values: 2048 nested tables at most

/// Walks through a text and keeps count of lines and columns.
class Cursor {
 public:
  explicit Cursor(std::string_view text) noexcept : rest_{text} {}

  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }
  [[nodiscard]] char here() const noexcept { return rest_.front(); }
  [[nodiscard]] bool at(std::string_view text) const noexcept { return rest_.starts_with(text); }
  [[nodiscard]] std::size_t size() const noexcept { return code_point_size(rest_); }
  [[nodiscard]] Place place() const noexcept { return place_; }

  /// By one code point.
  void advance() noexcept {
    const bool line_ends = here() == '\n';
    rest_.remove_prefix(size());
    place_ = line_ends ? Place{place_.line + 1, 1} : Place{place_.line, place_.column + 1};
  }
  void advance(std::size_t code_points) noexcept {
    for (; code_points > 0 && !at_end(); --code_points) advance();
  }

 private:
  std::string_view rest_;
  Place place_{1, 1};
};

/// The first byte that is not text.
bool check_characters(std::string_view text, Problems& problems) {
  for (Cursor cursor{text}; !cursor.at_end(); cursor.advance()) {
    if (cursor.here() == '\0') {
      problems.add(cursor.place(), "the file is not text: it holds a zero byte",
                   "a " + std::string{problems.kind().name} +
                       " is a text file; is this a binary file or UTF-16?");
      return false;
    }
    if (cursor.size() == 0) {
      problems.add(cursor.place(), "the file is not UTF-8 text", "save the file as UTF-8");
      return false;
    }
  }
  return true;
}

void skip_comment(Cursor& cursor) {
  while (!cursor.at_end() && cursor.here() != '\n') cursor.advance();
}

/// A string of one line or several; one that does not end is the parser's to report.
void skip_string(Cursor& cursor) {
  const bool escapes = cursor.here() == '"';
  const std::string one(1, cursor.here());
  const std::string three(3, cursor.here());
  const bool long_string = cursor.at(three);
  const std::string& end = long_string ? three : one;
  cursor.advance(end.size());
  while (!cursor.at_end() && !cursor.at(end)) {
    if (cursor.here() == '\n' && !long_string) return;
    cursor.advance(escapes && cursor.here() == '\\' ? 2 : 1);
  }
  cursor.advance(end.size());
}

/// A key such as a.b.c, or what is written like one: parts and dots with nothing else between.
bool belongs_to_key(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == ' ' || c == '\t';
}

void check_key_parts(std::string_view text, Problems& problems) {
  int parts = 1;
  for (Cursor cursor{text}; !cursor.at_end();) {
    const char c = cursor.here();
    if (c == '#') {
      skip_comment(cursor);
      continue;
    }
    if (c == '"' || c == '\'') {
      skip_string(cursor);
      continue;
    }
    if (c == '.' && ++parts > most_key_parts) {
      problems.add(cursor.place(), "this key has too many parts",
                   "no key has more than three: noise.rms.strain_x");
      return;
    }
    if (c != '.' && !belongs_to_key(c)) parts = 1;
    cursor.advance();
  }
}

bool check_not_empty(std::string_view text, Problems& problems) {
  for (Cursor cursor{text}; !cursor.at_end(); cursor.advance()) {
    if (cursor.here() == '#') skip_comment(cursor);
    if (cursor.at_end()) break;
    if (std::string_view{" \t\r\n"}.find(cursor.here()) == std::string_view::npos) return true;
  }
  problems.add({}, "the " + std::string{problems.kind().name} + " is empty",
               std::string{problems.kind().smallest});
  return false;
}

}  // namespace

void check_source_text(std::string_view text, Problems& problems) {
  if (check_characters(text, problems) && check_not_empty(text, problems))
    check_key_parts(text, problems);
}

}  // namespace tactile_net
