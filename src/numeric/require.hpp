/// @file
/// The checks of set-up values: "half_width must be > 0 (got -1)".
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {

/// @throw std::invalid_argument  with the rule as its text, unless `holds`
inline void require(bool holds, const std::string& rule) {
  if (!holds) throw std::invalid_argument(rule);
}

/// @param rule   completes "FIELD must ...": "be > 0"
/// @param value  any arithmetic type
/// @throw std::invalid_argument  unless `holds`
void require(bool holds, std::string_view field, std::string_view rule, auto value) {
  if (holds) return;
  throw std::invalid_argument(std::string(field) + " must " + std::string(rule) + " (got " +
                              shortest(value) + ")");
}

inline void require_finite(std::string_view field, double value) {
  require(std::isfinite(value), field, "be finite", value);
}

inline void require_positive(std::string_view field, double value) {
  require_finite(field, value);
  require(value > 0.0, field, "be > 0", value);
}

}  // namespace tactile_net
