/// @file
/// What a command talks to.
#pragma once

#include <iosfwd>
#include <string>

#include "terminal/text_style.hpp"

namespace tactile_net::tool {

struct Streams {
  std::istream& in;       ///< read for the path "-"
  std::ostream& out;      ///< results
  std::ostream& err;      ///< messages
  bool terminal = false;  ///< somebody watches `err`: progress may be shown there
  bool somebody = false;  ///< who watches `err` can answer on `in`
  /// The same as `err` without the care that is taken of it, for the progress line's own control
  /// characters; null: `err`.
  std::ostream* screen = nullptr;
  std::string command{};  ///< the line that was typed, for pages to say what made them
  TextStyle style{};      ///< of what is written to `out` for people to read
};

}  // namespace tactile_net::tool
