/// @file
/// From a file's text to TOML tables: what every kind of input file goes through.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "scene/problems.hpp"
#include "scene/value.hpp"

namespace tactile_net {

[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text) noexcept;

/// @param text      without a byte order mark, as `problems` was made with
/// @throw InputError  not fit for the parser, or not TOML
[[nodiscard]] toml::table parse_document(std::string_view text, const std::string& file,
                                         Problems& problems);

}  // namespace tactile_net
