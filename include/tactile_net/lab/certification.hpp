/// @file
/// What can be said of a scene's circuit before it is built.
#pragma once

#include <optional>

#include "tactile_net/lab/relaxation.hpp"

namespace tactile_net::lab {

struct Certification {
  Scene scene;
  CircuitPlan plan;
  Certificate certificate{};
  std::optional<ToleranceResult> tolerance{};
  Recommendation recommendation{};

  /// Whether there is an answer for the circuit to settle to.
  [[nodiscard]] bool loaded() const noexcept;
};

}  // namespace tactile_net::lab
