/// @file
/// What a large skin reads of tractions that are the same everywhere. Private.
#pragma once

#include "skin/large/system.hpp"

namespace tactile_net {

/// Weighted, of 1 Pa in every cell.
struct EvenReadings {
  double pressure = 0.0;  ///< the largest reading
  /// Of a drag along y or z, the lesser, by the living taxel that sees it least: the 2-norm over
  /// what it reads. Shear is read of it everywhere, stresses in the plane near the ends alone.
  double drag = 0.0;
};

[[nodiscard]] EvenReadings even_readings(LargeSkinSystem& system);

}  // namespace tactile_net
