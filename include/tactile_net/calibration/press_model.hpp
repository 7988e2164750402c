/// @file
/// Readings under rigid indenters by their transforms, with every derivative that a calibration
/// asks for. For a line
///
///     r(y) = P/pi integral_0^inf phi(k a) [even(k) cos k(y - c) + odd(k) sin k(y - c)] dk
///
/// `even` and `odd` are the pad's transforms (half_plane.hpp, pad_kernel.hpp) of normal load plus
/// friction times those of the tangential load; phi is the indenter's:
///
///     cylinder  2 J1(z)/z        punch (no rounded edge)  J0(z)        wedge  1/z integral_0^z J0
///
/// For a flat skin, at the distance r from the contact's middle and the angle theta from the y
/// axis, sums of
///
///     F/(2 pi) cos(n theta) integral_0^inf k phi(k a) T(k) J_n(k r) dk,    n = 0, 1, 2,
///
/// under a drag n = 3 as well, with the cosine or the sine; T are the pad's transforms
/// (docs/internals/space.md; skin_waves.hpp) and
///
///     sphere  3 j1(z)/z        punch  sin(z)/z        cone  2 (1 - cos z)/z^2
///
/// For a curved skin the same sums over spherical harmonics: a layer on a ball, bonded to it
/// (ball_kernel.hpp), whose radius is that of the mean curvature above each taxel. A drag is along
/// one direction at the contact's middle, and turns with the arcs from there.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/calibration/calibration_options.hpp"
#include "tactile_net/calibration/rod_contact.hpp"
#include "tactile_net/elasticity/contact.hpp"
#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/elasticity/quantity.hpp"
#include "tactile_net/elasticity/space/disc.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/sensing/array.hpp"
#include "tactile_net/sensing/effects/signal_layout.hpp"
#include "tactile_net/skin/array.hpp"

namespace tactile_net {

/// The pad as a calibration moves it: factors on the nominal pad, and values of their own.
struct PadState {
  double log_depth = 0.0;      ///< log of the factor on every taxel's depth
  double log_thickness = 0.0;  ///< log of the factor on the layer's thickness
  double poisson_ratio = 0.45;
  double log_modulus = 0.0;  ///< log of the factor on E
  double crosstalk = 0.0;
  double shift = 0.0;      ///< of the array along y [m]
  double log_pitch = 0.0;  ///< log of the factor on every taxel's place
  double shift_z = 0.0;    ///< of a skin [m]
};

/// An indenter as a calibration moves it.
struct PressState {
  Shape shape = Shape::cylinder;           ///< on a line
  double log_force = 0.0;                  ///< log of P [N/m], on a skin of F [N]
  double center = 0.0;                     ///< y of the middle [m]
  double log_half_width = 0.0;             ///< log of a [m]
  double friction = 0.0;                   ///< tangential over normal traction, along y
  double center_z = 0.0;                   ///< on a skin [m]
  DiscProfile disc = DiscProfile::sphere;  ///< on a skin
  double friction_z = 0.0;                 ///< on a skin
};

/// Readings and their derivatives, presses x readings each.
struct PressReadings {
  Matrix value{};
  std::array<Matrix, pad_parameter_count> by_pad{};  ///< by PadState's members, in their order
  Matrix by_log_force{}, by_center{}, by_log_half_width{}, by_friction{}, by_center_z{},
      by_friction_z{};
};

/// One array or one skin on one pad.
///
///     const PressModel model(scene.sensor, scene.material);
///     const PressReadings r = model.readings(model.nominal(), presses, true);
///     r.by_pad[0](0, 20);   // what the depth does to reading 20 of press 0
///
/// Costs presses x nodes x readings multiplications a quantity, nodes some 20 times the distance
/// of the farthest taxel over the depth; of a skin presses x nodes x radii, some 20 radii for each
/// depth of that distance; of a curved one presses x degrees x radii for each curvature and depth,
/// degrees some 40 times the radius over the depth. Const, and thread-safe. A copy shares what it
/// is made of.
class PressModel {
 public:
  /// @param crosstalk  fraction to each neighbour, as the effect has it: part of the nominal pad
  /// @throw std::invalid_argument  the array, the material or the fraction is out of range, taxels
  ///                               have widths, a layer slips under what a skin reads; a curved
  ///                               skin's pad is no bonded layer thinner than its radius, or its
  ///                               kernel is given
  PressModel(const SensorArray& array, const Material& material, double crosstalk = 0.0);
  PressModel(const SkinArray& skin, const Material& material, double crosstalk = 0.0);

  [[nodiscard]] PadState nominal() const noexcept;

  /// Readings before gains and offsets, crosstalk applied; within 1e-9 of a press' peak.
  ///
  /// @param with_derivatives  else `value` alone is filled
  /// @param tied_to_base      thickness is the depth: log_thickness is not read, and its share is
  ///                          in the derivative by the depth
  /// @param by_friction       a skin's derivatives by friction, too: they cost as much as the rest
  /// @throw std::invalid_argument  a skin is dragged, or by_friction, and not `holds_drags`
  [[nodiscard]] PressReadings readings(const PadState& pad, std::span<const PressState> presses,
                                       bool with_derivatives, bool tied_to_base = false,
                                       bool by_friction = false) const;

  /// The radius [m] of what touches a plane as a ball of this radius touches the skin at a place:
  /// 1 / (1 / radius + mean curvature), after Hertz. On a flat pad the radius itself.
  /// @throw std::invalid_argument  the skin is a hole there, and no wider than the ball
  [[nodiscard]] double relative_radius(double radius, double y, double z) const;
  /// The radius of the ball whose relative radius this is there; infinite where a flat punch, or
  /// less, would do.
  [[nodiscard]] double radius_of_relative(double relative, double y, double z) const;

  // Of the following, radii are relative ones.

  /// The force that a contact of this half width needs: `rod_force`, on a skin `ball_force`.
  [[nodiscard]] ContactForce contact_force(const Material& material, double half_width,
                                           double radius) const;
  /// The half width [m] of a rod's contact, on a skin the radius of a ball's, under a force.
  [[nodiscard]] double contact_half_width(const Material& material, double force,
                                          double radius) const;
  /// The radius [m] of the rod or ball whose contact has this half width under a force.
  [[nodiscard]] double indenter_radius(const Material& material, double half_width,
                                       double force) const;

  /// True if all readings are finite under a drag: displacements along a base that slips are not.
  [[nodiscard]] bool holds_drags() const;

  /// Largest crosstalk that a fit may use: a little below what a taxel can lose to its neighbours.
  [[nodiscard]] double most_crosstalk() const noexcept;

  [[nodiscard]] bool is_skin() const noexcept { return is_skin_; }
  [[nodiscard]] bool is_curved() const noexcept { return curved_ != nullptr; }
  /// The thickness [m] that a fit may not exceed: most of the least radius of a curved skin;
  /// infinite on a flat one.
  [[nodiscard]] double most_thickness() const noexcept;
  [[nodiscard]] const Material& material() const noexcept { return material_; }
  [[nodiscard]] const std::vector<Site>& sites() const noexcept { return layout_.readings; }
  [[nodiscard]] const std::vector<Channel>& channels() const noexcept { return layout_.channels; }
  [[nodiscard]] double pitch() const noexcept { return pitch_; }  ///< of a skin the larger one [m]
  [[nodiscard]] double depth() const noexcept { return depth_; }  ///< the least, nominal [m]

 private:
  void check_and_finish(double crosstalk);
  [[nodiscard]] double curvature_at(double y, double z) const;

  Material material_;
  bool is_skin_;
  SignalLayout layout_;
  double pitch_;
  double depth_ = 0.0;
  double crosstalk_;
  std::shared_ptr<const CurvedSkin> curved_{};
};

}  // namespace tactile_net
