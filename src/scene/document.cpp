#include "scene/document.hpp"

#include <array>
#include <string>

#include "scene/source_text.hpp"

namespace tactile_net {

namespace {

/// What to do about a syntax error, by a part of the parser's words; the first that fits counts.
struct Advice {
  std::string_view part;
  std::string_view hint;
};
constexpr std::array advice = {
    Advice{"could not determine value type", "text stands in \"quotes\", a list in [brackets]"},
    Advice{"parsing boolean", "true and false are lower case; text stands in \"quotes\""},
    Advice{"parsing floating-point", "a number has digits on both sides of its point: 0.5, 2.0"},
    Advice{"redefine existing", "each key and each [table] stands once; join the two"},
    Advice{"leading zero", "write the number without leading zeros"},
    Advice{"saw ','", "one key a line; the decimal sign is a point: 0.5"},
    Advice{"expected a comment or whitespace", "one key a line, and no unit behind a number"},
    Advice{"expected '='", "a line is key = value"},
    Advice{"expected ']'",
           "a table begins with [name], a contact with [[contact]], a finger with [[finger]]"},
    Advice{"parsing inline table", "{ a = 1, b = 2 } stands on one line"},
    Advice{"control characters", "text ends on the line where it began"},
};

std::string hint_for(std::string_view description) {
  for (const auto& [part, hint] : advice)
    if (description.find(part) != std::string_view::npos) return std::string{hint};
  return {};
}

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) noexcept {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text;
}

toml::table parse_document(std::string_view text, const std::string& file, Problems& problems) {
  check_source_text(text, problems);
  problems.throw_if_any();
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    constexpr std::string_view start = "Error while parsing ";
    std::string_view words = error.description();
    if (words.starts_with(start)) words.remove_prefix(start.size());
    problems.add(place_of(error.source().begin), "not valid TOML: " + std::string{words},
                 hint_for(error.description()));
  }
  problems.throw_if_any();
  return {};
}

}  // namespace tactile_net
