/// @file
/// One kernel of the pad as it is, half plane or layer: the reading that a line load causes.
#pragma once

#include <complex>
#include <memory>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

class LayerCorrection;

/// Fourier transform of a pad's kernel: `half_plane_transform` or `layer_transform`.
[[nodiscard]] std::complex<double> pad_transform(Quantity quantity, Traction component,
                                                 const Material& material, double depth,
                                                 double wavenumber) noexcept;

/// Largest error of a `PadKernel` over the half plane's peak: 8 ulp on a half plane, 1e-13 in a
/// layer.
[[nodiscard]] double relative_kernel_error(const Material& material) noexcept;

/// Error of what a layer's base adds to a kernel: 1e-13 of the half plane's peak at the base's
/// depth [Pa / (N/m) for stress, 1 / (N/m) for strain]; 0 on a half plane. Readings that vanish at
/// the base are to be judged by it.
[[nodiscard]] double base_error(Quantity quantity, const Material& material) noexcept;

/// The reading at a given depth caused by a unit line load, as a function of the lateral distance.
///
/// On a half plane it is the closed form. In a layer it is the closed form plus what the base adds,
/// by interpolation: beyond 48 layers from the load no more than the limit, which is 0, or the
/// constant of the tangential load on a frictionless base. A copy shares the interpolants.
class PadKernel {
 public:
  /// O(1) on a half plane; about 4 million multiplications in a layer.
  ///
  /// @throw std::invalid_argument  the material is out of range; depth is not > 0, or below the
  ///                               base; a line array does not read that quantity, or a line's load
  ///                               does not have that component
  PadKernel(Quantity quantity, Traction component, const Material& material, double depth);

  /// The reading at the distance y [m] from the load [Pa / (N/m) for stress, 1 / (N/m) for strain],
  /// within `relative_kernel_error` of the half plane's peak.
  [[nodiscard]] double operator()(double y) const noexcept;

 private:
  Quantity quantity_;
  Traction component_;
  Material material_;
  double depth_;
  std::shared_ptr<const LayerCorrection> correction_{};  // absent: half plane
};

}  // namespace tactile_net
