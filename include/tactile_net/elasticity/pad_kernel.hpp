/// @file
/// One kernel of the pad as it is, half plane or layer: what the rest of the library calls.
#pragma once

#include <complex>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The transform of a kernel: `half_plane_transform` or `layer_transform`.
[[nodiscard]] std::complex<double> pad_transform(Quantity quantity, Traction component,
                                                 const Material& material, double depth,
                                                 double wavenumber) noexcept;

/// Largest error of a `PadKernel` over the half plane's peak: 8 ulp on a half plane, 1e-13 in a
/// layer.
[[nodiscard]] double relative_kernel_error(const Material& material) noexcept;

/// The reading at a given depth caused by a unit line load, as a function of the lateral distance.
///
/// On a half plane it is the closed form. In a layer it is the closed form plus a correction, whose
/// transform (layer minus half plane) decays as exp(-|k| (2 h - depth)) whatever the depth:
///
///     correction(y) = 1/pi integral_0^inf Re[(T_layer - T_half)(k) exp(i k y)] dk,
///
/// by Gauss-Legendre panels that resolve exp(i k y), kept as Chebyshev interpolants of panels h/2
/// wide. Beyond 48 h the kernel is below 1e-15 of its peak (its poles lie at |Im k h| >= 0.739) and
/// its limit is returned: 0, or the constant of the tangential load on a frictionless base.
class PadKernel {
 public:
  /// O(1) on a half plane; about 4 million multiplications in a layer.
  ///
  /// @throw std::invalid_argument  the material is out of range; depth is not > 0, or below the
  /// base
  PadKernel(Quantity quantity, Traction component, const Material& material, double depth);

  /// At the distance y [m] from the load [Pa / (N/m) for stress, 1 / (N/m) for strain], within
  /// `relative_kernel_error` of the half plane's peak.
  [[nodiscard]] double operator()(double y) const noexcept;

 private:
  Quantity quantity_;
  Traction component_;
  Material material_;
  double depth_;
  bool is_odd_;
  double limit_ = 0.0;            // at infinite y > 0
  std::vector<double> values_{};  // of the correction, panel by panel at Chebyshev points
};

}  // namespace tactile_net
