/// @file
/// A TOML file's text with some of its parts replaced, all else byte for byte. Private.
#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tactile_net {

/// The text's lines, whose parts are replaced from the end to the beginning.
class EditedText {
 public:
  explicit EditedText(std::string_view text) : text_(text) {
    starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') starts_.push_back(i + 1);
  }

  /// Where a position of the parser is; columns count code points, from 1.
  [[nodiscard]] std::size_t at(const toml::source_position& position) const {
    std::size_t offset = starts_.at(position.line - 1);
    for (std::size_t column = 1; column < position.column; ++column) {
      ++offset;
      while (offset < text_.size() && (static_cast<unsigned char>(text_[offset]) & 0xC0) == 0x80)
        ++offset;
    }
    return offset;
  }
  void replace(std::size_t from, std::size_t to, std::string with) {
    edits_.push_back({from, to, std::move(with)});
  }
  void replace(const toml::node& node, std::string with) {
    replace(at(node.source().begin), at(node.source().end), std::move(with));
  }
  /// A key with its value, which begins its line.
  /// @throw std::invalid_argument  it does not
  void replace_line_part(const toml::source_position& from, const toml::source_position& to,
                         std::string with) {
    const std::size_t begin = at(from);
    if (text_.find_first_not_of(" \t", starts_.at(from.line - 1)) != begin)
      throw std::invalid_argument(
          "calibrate writes sensor.taxels anew: let it begin a line of a table [sensor]");
    replace(begin, at(to), std::move(with));
  }
  /// A line above that of a key's value.
  void insert_line_before(const toml::source_position& value, std::string line) {
    const std::size_t at = starts_.at(value.line - 1);
    replace(at, at, std::move(line));
  }
  /// A table from its header up to its last line that says something.
  void remove(const toml::table& table) {
    const std::size_t from = starts_.at(table.source().begin.line - 1);
    std::size_t line = table.source().begin.line;
    std::size_t to = line < starts_.size() ? starts_[line] : text_.size();
    for (; line < starts_.size(); ++line) {
      const std::string_view content = line_of(line);
      const std::size_t first = content.find_first_not_of(" \t\r\n");
      if (first != std::string_view::npos && content[first] == '[' && !inside_value(from, line))
        break;
      if (first != std::string_view::npos && content[first] != '#')
        to = line + 1 < starts_.size() ? starts_[line + 1] : text_.size();
    }
    replace(from, to, "");
  }
  [[nodiscard]] std::string text() && {
    std::sort(edits_.begin(), edits_.end(),
              [](const Edit& a, const Edit& b) { return a.from > b.from; });
    for (const Edit& edit : edits_) text_.replace(edit.from, edit.to - edit.from, edit.with);
    return std::move(text_);
  }

 private:
  struct Edit {
    std::size_t from, to;
    std::string with;
  };
  [[nodiscard]] std::string_view line_of(std::size_t line) const {
    const std::size_t end = line + 1 < starts_.size() ? starts_[line + 1] : text_.size();
    return std::string_view(text_).substr(starts_[line], end - starts_[line]);
  }
  /// The line goes on with a list that an earlier one began.
  [[nodiscard]] bool inside_value(std::size_t from, std::size_t line) const {
    long depth = 0;
    bool in_comment = false;
    for (std::size_t i = from; i < starts_[line]; ++i) {
      if (text_[i] == '\n') in_comment = false;
      if (text_[i] == '#') in_comment = true;
      if (in_comment) continue;
      if (text_[i] == '[') ++depth;
      if (text_[i] == ']') --depth;
    }
    return depth > 0;
  }

  std::string text_;
  std::vector<std::size_t> starts_{};
  std::vector<Edit> edits_{};
};

}  // namespace tactile_net
