/// @file
/// The reading that a hat of traction causes: the column of a problem whose tractions are straight
/// lines between the points of a surface grid.
///
///     g(u) = integral of k(u - s) (1 - |s| / w) ds,  |s| <= w = half_width
///
/// Where the taxel is three half widths from the hat's middle or farther, ten points of Gauss and
/// Legendre on each side are exact. Closer by, every stress of a half plane is a real or imaginary
/// part of the hat's Cauchy transform C(z), the integral of hat(s) / (z - s) ds at z = u + i depth,
/// and of depth C'(z) (Muskhelishvili):
///
///     C  = [(z + w) log(z + w) - 2 z log z + (z - w) log(z - w)] / w
///     C' = [log(z + w) - 2 log z + log(z - w)] / w.
#pragma once

#include <memory>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

class LayerCorrection;

/// One quantity at one depth, as a function of the lateral distance from the middle of a hat of
/// traction: 1 Pa there, falling linearly to 0 at +-half_width.
///
/// Hats may be far narrower and far wider than they are deep, and far away: nothing cancels. In a
/// layer what the base adds is interpolated as in `PadKernel`; a hat wider than eight layers is
/// made of narrower ones. A copy shares the interpolants.
class HatKernel {
 public:
  /// O(1) on a half plane; about as much as a `PadKernel` in a layer.
  ///
  /// @throw std::invalid_argument  the material is out of range; depth is not > 0, or below the
  ///                               base; a line array does not read that quantity, or a line's load
  ///                               does not have that component; half_width [m] is not > 0
  HatKernel(Quantity quantity, Traction component, const Material& material, double depth,
            double half_width);

  /// The reading at the distance u [m] from the middle of the hat [Pa / Pa for stress, 1 / Pa for
  /// strain], of even or odd parity to the bit. Costs 20 line kernels or three logarithms, in a
  /// layer an interpolation more; where the hat is wider than eight layers, up to 28 times that.
  [[nodiscard]] double operator()(double u) const noexcept;

  /// Bound of the rounding error at u: nearer than three half widths 18 ulp of what a uniform
  /// traction causes at the surface, elsewhere 18 ulp of the integral of |k|; in a layer
  /// `base_error` times the hat's area, or times the layer's thickness where that is less, besides.
  [[nodiscard]] double error_bound(double u) const noexcept;

 private:
  [[nodiscard]] double half_plane(double u) const noexcept;
  [[nodiscard]] double part(double u) const noexcept;

  Quantity quantity_;
  Traction component_;
  Material material_;
  double depth_;
  double potential_ = 0.0;  // weight of C in a half plane's reading
  double slope_ = 0.0;      // of depth C'
  double parts_ = 1.0;      // hats of which this one is made: one, except for wide ones in a layer
  double part_width_;       // half of it
  std::shared_ptr<const LayerCorrection> correction_{};  // of a part; absent: half plane
  double layer_error_ = 0.0;
};

}  // namespace tactile_net
