/// @file
/// What a large skin reads of tractions that are the same everywhere. Private.
#pragma once

#include "skin/large/system.hpp"

namespace tactile_net {

/// Weighted readings of 1 Pa in every cell.
struct UniformReadings {
  double pressure = 0.0;  ///< the largest reading
  /// The 2-norm of what the living taxel that sees a uniform drag least reads of it; the lesser of
  /// the drags along y and z. Shear is read everywhere, stresses in the plane near the ends alone.
  double drag = 0.0;
};

[[nodiscard]] UniformReadings uniform_readings(LargeSkinSystem& system);

}  // namespace tactile_net
