/// @file
/// Readings under rigid indenters by their transforms, with every derivative that a calibration
/// asks for.
///
///     r(y) = P/pi integral_0^inf phi(k a) [even(k) cos k(y - c) + odd(k) sin k(y - c)] dk
///
/// `even` and `odd` are the pad's transforms (half_plane.hpp, layer.hpp) of normal load plus
/// friction times those of the tangential load; phi is the indenter's:
///
///     cylinder  2 J1(z)/z        punch (no rounded edge)  J0(z)        wedge  1/z integral_0^z J0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/calibration/calibration_options.hpp"
#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

/// The pad as a calibration sees it: factors on the nominal one, and what a scene has none of.
struct PadState {
  double log_depth = 0.0;      ///< of the factor on every taxel's depth
  double log_thickness = 0.0;  ///< of the factor on the layer's thickness
  double poisson_ratio = 0.45;
  double log_modulus = 0.0;  ///< of the factor on E
  double crosstalk = 0.0;
  double shift = 0.0;      ///< of the array [m]
  double log_pitch = 0.0;  ///< of the factor on every taxel's place
};

/// An indenter as a calibration moves it.
struct PressState {
  Shape shape = Shape::cylinder;
  double log_force = 0.0;       ///< of P [N/m]
  double center = 0.0;          ///< c [m]
  double log_half_width = 0.0;  ///< of a [m]
  double friction = 0.0;
};

/// Readings and their derivatives, presses x readings each.
struct PressReadings {
  Matrix value{};
  std::array<Matrix, pad_parameter_count> by_pad{};  ///< by PadState's members, in their order
  Matrix by_log_force{}, by_center{}, by_log_half_width{}, by_friction{};
};

/// One array on one pad.
///
///     const PressModel model(scene.sensor, scene.material);
///     const PressReadings r = model.readings(model.nominal(), presses, true);
///     r.by_pad[0](0, 20);   // what the depth does to reading 20 of press 0
///
/// Costs presses x nodes x readings multiplications a quantity, nodes some 20 times the distance
/// of the farthest taxel over the depth; const, and thread-safe.
class PressModel {
 public:
  /// @param crosstalk  fraction to each neighbour, as the effect has it: part of the nominal pad
  /// @throw std::invalid_argument  the array, the material or the fraction is out of range, or
  ///                               taxels have widths
  PressModel(const SensorArray& array, const Material& material, double crosstalk = 0.0);

  [[nodiscard]] PadState nominal() const noexcept;

  /// Before gains and offsets, crosstalk applied; within 1e-9 of a press' peak.
  ///
  /// @param with_derivatives  else `value` alone is filled
  /// @param tied_to_base      thickness is the depth: log_thickness is not read, and its share is
  ///                          in the derivative by the depth
  [[nodiscard]] PressReadings readings(const PadState& pad, std::span<const PressState> presses,
                                       bool with_derivatives, bool tied_to_base = false) const;

  [[nodiscard]] const Material& material() const noexcept { return material_; }
  [[nodiscard]] const std::vector<Site>& sites() const noexcept { return sites_; }
  [[nodiscard]] const SensorArray& array() const noexcept { return array_; }
  [[nodiscard]] double depth() const noexcept { return depth_; }  ///< the least, nominal [m]

 private:
  SensorArray array_;
  Material material_;
  std::vector<Site> sites_;
  double depth_;
  double crosstalk_;
};

}  // namespace tactile_net
