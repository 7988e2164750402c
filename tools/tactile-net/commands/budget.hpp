/// @file
/// What --budget says.
#pragma once

#include <optional>

#include "commands/share.hpp"
#include "failure.hpp"

namespace tactile_net::tool {

/// @throw WrongUsage  it is not > 0 and below 1
[[nodiscard]] inline std::optional<double> share_of(const std::optional<Share>& budget) {
  if (!budget) return std::nullopt;
  if (!(budget->value > 0.0 && budget->value < 1.0))
    throw WrongUsage("--budget", "must be > 0 and below 1 (100 %), such as 0.3%");
  return budget->value;
}

}  // namespace tactile_net::tool
