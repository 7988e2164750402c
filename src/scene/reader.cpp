#include "tactile_net/scene/reader.hpp"

#include <toml++/toml.h>

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "scene/problems.hpp"
#include "scene/sections.hpp"
#include "scene/source_text.hpp"
#include "scene/table.hpp"

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
    Advice{"expected ']'", "a table begins with [name], a contact with [[contact]]"},
    Advice{"parsing inline table", "{ a = 1, b = 2 } stands on one line"},
    Advice{"control characters", "text ends on the line where it began"},
};

std::string hint_for(std::string_view description) {
  for (const auto& [part, hint] : advice)
    if (description.find(part) != std::string_view::npos) return std::string{hint};
  return {};
}

std::optional<toml::table> parse(std::string_view text, const std::string& file,
                                 Problems& problems) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    constexpr std::string_view start = "Error while parsing ";
    std::string_view words = error.description();
    if (words.starts_with(start)) words.remove_prefix(start.size());
    problems.add(place_of(error.source().begin), "not valid TOML: " + std::string{words},
                 hint_for(error.description()));
    return std::nullopt;
  }
}

Scene parse_named(std::string_view text, const std::string& file, std::string name) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());

  Problems problems{file, text};
  check_source_text(text, problems);
  problems.throw_if_any();

  const auto toml = parse(text, file, problems);
  problems.throw_if_any();

  Scene scene;
  scene.file = std::move(name);
  Table root{*toml, "", problems};
  read_sections(root, scene);
  problems.throw_if_any();
  return scene;
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  return parse_named(source_text(path), path.string(), path.filename().string());
}

Scene parse_scene(std::string_view toml, const std::string& file) {
  return parse_named(toml, file, std::filesystem::path{file}.filename().string());
}

}  // namespace tactile_net
