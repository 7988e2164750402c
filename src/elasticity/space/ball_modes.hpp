/// @file
/// A layer on a rigid ball under a traction that is one spherical harmonic. Private.
#pragma once

#include <cstddef>

namespace tactile_net {

/// What a traction of degree n causes at one depth, at the unit sphere's gradients: with Y a
/// harmonic, the displacement U Y e_r + V grad Y + W e_r x grad Y and the stress s_rr = S Y,
/// s_r. = T grad Y + T_W e_r x grad Y, in tension; the surface's radius and G are 1.
struct BallMode {
  /// Under a traction of the kinds U and V.
  struct Spheroidal {
    double radial = 0.0;      ///< U
    double along = 0.0;       ///< V
    double stress = 0.0;      ///< S
    double shear = 0.0;       ///< T
    double mean_along = 0.0;  ///< half the trace of the stress along the sphere, over Y
  };
  Spheroidal normal{};       ///< under s_rr = Y
  Spheroidal tangential{};   ///< under s_r. = grad Y
  double twist = 0.0;        ///< W under s_r. = e_r x grad Y
  double twist_shear = 0.0;  ///< T_W
};

/// The modes of one layer at one depth, by Love's solid harmonics (1927, article 172; in the notes
/// of docs/internals/space.md). Their powers are scaled to be 1 at the face to which they belong,
/// so that none overflows, and the second of each pair vanishes there but for its radial part, so
/// that the two stay apart at every degree. Nothing is divided by 1 - 2 nu.
class BallModes {
 public:
  /// @param nu         Poisson's ratio, [0, 0.5]
  /// @param curvature  thickness over radius: in (0, 1) on a ball, < 0 in a cup
  /// @param depth      [0, 1], in units of the thickness
  BallModes(double nu, double curvature, double depth) noexcept;

  /// @param n  degree, any
  [[nodiscard]] BallMode operator()(std::size_t n) const noexcept;

  /// Degrees that matter: those beyond are below exp(-40) of the largest.
  [[nodiscard]] std::size_t degrees() const noexcept;

 private:
  [[nodiscard]] BallMode breathing() const noexcept;

  double nu_;
  double core_;        // its radius
  double log_core_;    // the logarithm of it
  double log_place_;   // and of the place's radius, which lies between 0 and the former
  double place_;       // the place's radius
  double core_rise_;   // core^2 - 1
  double place_rise_;  // place^2 - 1
  double place_rest_;  // place^2 - core^2
};

}  // namespace tactile_net
