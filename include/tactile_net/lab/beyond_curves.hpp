/// @file
/// Whether the curves of a circuit's devices leave an answer.
#pragma once

#include <optional>

#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::lab {

/// Absent: they do. Otherwise they may change it by more than half of itself.
[[nodiscard]] std::optional<Disagreement> beyond_curves(
    const ExplainedDifference& explained) noexcept;

}  // namespace tactile_net::lab
