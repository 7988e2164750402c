/// @file
/// What tests of press models share, of lines and of skins.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tactile_net/calibration/press_model.hpp"

namespace tactile_net {

/// A half space, a layer that is bonded to its base, one that slips on it.
inline Material pad_of(int kind) {
  Material material{.youngs_modulus = 2e5, .poisson_ratio = 0.45};
  if (kind > 0) material.layer = Layer{3e-3, kind == 1 ? Base::bonded : Base::frictionless};
  return material;
}

inline double peak(const Matrix& rows, std::size_t row) {
  double most = 0.0;
  for (const double value : rows.row(row)) most = std::max(most, std::abs(value));
  return most;
}

/// Another place in the space of parameters, by `step` along one of them.
inline PadState moved(PadState pad, std::size_t parameter, double step) {
  double* const members[] = {&pad.log_depth,   &pad.log_thickness, &pad.poisson_ratio,
                             &pad.log_modulus, &pad.crosstalk,     &pad.shift,
                             &pad.log_pitch,   &pad.shift_z};
  *members[parameter] += step;
  return pad;
}

}  // namespace tactile_net
