/// @file
/// The functions of half_space_field.hpp for a unit force at the origin. Private.
#pragma once

#include <cmath>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// Powers of 1 / R times polynomials of the direction cosines and q = R / (R + x): each function is
/// exact to a few ulp.
template <class Number>
class PointSource {
 public:
  /// @param x  depth, > 0; @param y, z  from the load, in units that keep squares from overflowing
  PointSource(Number x, Number y, Number z) noexcept {
    using std::sqrt;
    inverse_ = 1.0 / sqrt(x * x + (y * y + z * z));
    cosine_x_ = x * inverse_;
    cosine_y_ = y * inverse_;
    cosine_z_ = z * inverse_;
    q_ = 1.0 / (1.0 + cosine_x_);
  }

  /// 3 a b c / R^5.
  [[nodiscard, gnu::always_inline]] Number radial(Axis a, Axis b, Axis c) const noexcept {
    return 3.0 * at(a) * at(b) * at(c) * inverse_ * inverse_;
  }
  /// delta_ac / R + a c / R^3.
  [[nodiscard, gnu::always_inline]] Number near(Axis a, Axis c) const noexcept {
    return (delta(a, c) + at(a) * at(c)) * inverse_;
  }
  /// phi's derivatives, along any axes.
  [[nodiscard, gnu::always_inline]] Number phi(Axis a) const noexcept {
    return a == Axis::x ? inverse_ : at(a) * q_ * inverse_;
  }
  [[nodiscard, gnu::always_inline]] Number phi(Axis a, Axis b) const noexcept {
    if (a == Axis::x || b == Axis::x) return -at(a == Axis::x ? b : a) * inverse_ * inverse_;
    return (delta(a, b) * q_ - at(a) * at(b) * q_ * q_ * (2.0 + cosine_x_)) * inverse_ * inverse_;
  }
  [[nodiscard]] Number phi_of_three(Axis a, Axis b, Axis c) const noexcept {
    const Number cube = inverse_ * inverse_ * inverse_;
    if (c == Axis::x) return (3.0 * at(a) * at(b) - delta(a, b)) * cube;
    if (b == Axis::x) return phi_of_three(a, c, b);
    if (a == Axis::x) return phi_of_three(b, c, a);
    const Number x = cosine_x_;
    return (at(a) * at(b) * at(c) * q_ * (3.0 * x * x + 9.0 * x + 8.0) -
            (delta(a, b) * at(c) + delta(b, c) * at(a) + delta(c, a) * at(b)) * (2.0 + x)) *
           q_ * q_ * cube;
  }
  /// chi's derivatives along y and z.
  [[nodiscard, gnu::always_inline]] Number chi(Axis a, Axis b) const noexcept {
    return (at(a) * at(b) * q_ - delta(a, b)) * q_ * inverse_;
  }
  [[nodiscard, gnu::always_inline]] Number chi(Axis a, Axis b, Axis c) const noexcept {
    return (delta(a, b) * at(c) + delta(b, c) * at(a) + delta(c, a) * at(b) -
            at(a) * at(b) * at(c) * q_ * (3.0 + cosine_x_)) *
           q_ * q_ * inverse_ * inverse_;
  }

 private:
  [[nodiscard]] const Number& at(Axis a) const noexcept {
    return a == Axis::x ? cosine_x_ : a == Axis::y ? cosine_y_ : cosine_z_;
  }
  static double delta(Axis a, Axis b) noexcept { return a == b ? 1.0 : 0.0; }

  Number cosine_x_, cosine_y_, cosine_z_;
  Number inverse_;  // 1 / R
  Number q_;
};

}  // namespace tactile_net
