/// @file
/// The elastic pad: linear, isotropic, homogeneous, in plane strain.
#pragma once

namespace tactile_net {

struct Material {
  double youngs_modulus = 1.0;  ///< E [Pa], > 0
  double poisson_ratio = 0.45;  ///< nu, [0, 0.5]
};

/// @throw std::invalid_argument  a value is out of its range or not finite
void check(const Material& material);

}  // namespace tactile_net
