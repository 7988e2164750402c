/// @file
/// Single numbers out of a JSON text.
#pragma once

#include <string>

#include "tests/catch.hpp"

namespace tactile_net {

/// The number after the first `key`.
inline double json_number(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\": ");
  REQUIRE(at != std::string::npos);
  return std::stod(json.substr(at + key.size() + 4));
}

}  // namespace tactile_net
