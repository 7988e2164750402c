/// @file
/// What the base of a layer adds to a half plane's reading. Private.
#pragma once

#include <cstddef>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// The transform of layer minus half plane decays as exp(-|k| (2 h - depth)) whatever the depth:
///
///     correction(y) = 1/pi integral_0^inf Re[(T_layer - T_half)(k) L(k) exp(i k y)] dk,
///
/// with the load's transform L(k): 1 for a line load, w sinc^2(k w / 2) for a hat of half width w.
/// It is taken by Gauss-Legendre panels that resolve exp(i k y), and kept as Chebyshev interpolants
/// of panels h/2 wide. Beyond `reach`, 48 h from the load, the reading is below 1e-15 of its peak
/// (the kernel's poles lie at |Im k h| >= 0.739) and its limit is returned: 0, or the constant of
/// the tangential load on a frictionless base.
class LayerCorrection {
 public:
  /// About 4 million multiplications, more for a hat wider than h.
  ///
  /// @param material    checked by the caller, with a layer that holds `depth`
  /// @param half_width  of a hat with the value 1 at its centre [m]; 0: a unit line load
  LayerCorrection(Quantity quantity, Traction component, const Material& material, double depth,
                  double half_width = 0.0);

  /// The layer's reading at the distance y [m] from the load's middle, given the half plane's.
  [[nodiscard]] double corrected(double half_plane, double y) const noexcept;

  [[nodiscard]] double reach() const noexcept {
    return panel_width_ * static_cast<double>(panels_);
  }
  [[nodiscard]] double limit() const noexcept { return limit_; }  ///< at infinite y > 0

 private:
  bool is_odd_;
  double panel_width_;          // [m]
  std::size_t panels_;          // on y >= 0
  double limit_;                // at infinite y > 0
  std::vector<double> values_;  // panel by panel at Chebyshev points
};

}  // namespace tactile_net
