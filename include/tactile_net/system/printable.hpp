/// @file
/// Text of strangers made fit for a terminal or a page: the one place that says which characters
/// must not reach them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tactile_net {

/// Bytes of the UTF-8 code point that begins `text`, 1 to 4; 0: not UTF-8. `text` must not be
/// empty.
[[nodiscard]] std::size_t code_point_size(std::string_view text) noexcept;

/// A name or a sentence of one line. What would drive a terminal, or make a text look like another,
/// is written as its number: control characters but the tab, and bytes that are not UTF-8, as
/// `\x1b`; what turns the direction of writing, and Unicode's own line ends, as `\u202e`.
[[nodiscard]] std::string printable(std::string_view text);

/// The same of a text of several lines, whose line feeds stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

/// The same of a JSON document, in JSON's own way of writing a character's number, `\u001b`: what
/// it says stays the same.
[[nodiscard]] std::string printable_json(std::string_view text);

}  // namespace tactile_net
