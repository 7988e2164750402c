/// @file
/// What a command talks to.
#pragma once

#include <iosfwd>

namespace tactile_net::tool {

struct Streams {
  std::istream& in;       ///< read for the path "-"
  std::ostream& out;      ///< results
  std::ostream& err;      ///< messages
  bool terminal = false;  ///< somebody watches `err`: progress may be shown there
};

}  // namespace tactile_net::tool
