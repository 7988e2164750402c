/// @file
/// A controller's plan as Python holds it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "tactile_net/realtime/estimator_plan.hpp"

namespace tactile_net::python {

/// Never changes, so that estimators may share it.
struct Plan {
  EstimatorPlan plan{};
  std::string why{};             ///< what was chosen, and against what; empty: read from a file
  bool for_raw_numbers = false;  ///< of the scene's calibration
  bool needs_baseline = false;   ///< an unloaded frame, before the first update
  /// Of an even skin's taxels, where they are known; 0: a line, or taxels anywhere, or the file
  /// does not say.
  std::size_t rows = 0;
  std::size_t columns = 0;

  [[nodiscard]] bool is_lattice() const noexcept { return rows > 0; }
};

using PlanPointer = std::shared_ptr<const Plan>;

}  // namespace tactile_net::python
