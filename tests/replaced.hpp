/// @file
/// A text with one part of it in other words.
#pragma once

#include <string>

#include "tests/catch.hpp"

namespace tactile_net {

/// The first `what`, which must be there, in place of which stands `with`.
inline std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), with);
}

}  // namespace tactile_net
