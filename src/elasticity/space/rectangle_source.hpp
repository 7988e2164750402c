/// @file
/// The functions of half_space_field.hpp for a uniform traction on a rectangle. Private.
#pragma once

#include <cmath>

#include "tactile_net/elasticity/quantity.hpp"

namespace tactile_net {

/// Integrals of the functions of `PointSource` over y and z, up to terms that cancel in the signed
/// sum over a rectangle's four corners (Love 1929 has those of the normal load).
template <class Number>
class CornerSource {
 public:
  /// @param x  depth, > 0; @param y, z from the corner, in units that keep squares from overflowing
  CornerSource(Number x, Number y, Number z) noexcept : x_(x), at_{y, z} {
    using std::sqrt;
    square_[0] = x * x + y * y;
    square_[1] = x * x + z * z;
    r_ = sqrt(square_[0] + z * z);
  }

  [[nodiscard]] Number radial(Axis a, Axis b, Axis c) const noexcept {
    const auto count = [&](Axis along) {
      return (a == along ? 1 : 0) + (b == along ? 1 : 0) + (c == along ? 1 : 0);
    };
    const int ys = count(Axis::y);
    const int zs = count(Axis::z);
    if (ys == 1 && zs == 1) return x_ / r_;
    if (ys == 0 && zs == 0)
      return y() * z() * x_ / r_ * (r_ * r_ + x_ * x_) / (square_[0] * square_[1]) + angle();
    // What is left has one of the two axes more often: call it s, the other t.
    const Axis s = ys > zs ? Axis::y : Axis::z;
    const Number share = at(across(s)) / (r_ * square(s));
    switch (ys > zs ? ys : zs) {
      case 1:
        return -x_ * x_ * share;
      case 2:
        return ys + zs == 3 ? at(s) / r_ - area(across(s)) : angle() - x_ * at(s) * share;
      default:
        return -2.0 * area(s) - at(s) * at(s) * share;
    }
  }
  [[nodiscard]] Number near(Axis a, Axis c) const noexcept {
    if (a == Axis::x && c == Axis::x) return x_ * angle() + phi(Axis::x);
    if (a == Axis::x || c == Axis::x) return -x_ * area(a == Axis::x ? c : a);
    return a == c ? 2.0 * phi(Axis::x) - at(a) * area(a) : -r_;
  }
  [[nodiscard]] Number phi(Axis a) const noexcept {
    if (a == Axis::x) return y() * area(Axis::y) + z() * area(Axis::z) - x_ * angle();
    return at(across(a)) * log_s() + x_ * area(a) + at(a) * second(a);
  }
  [[nodiscard]] Number phi(Axis a, Axis b) const noexcept { return a == b ? second(a) : log_s(); }
  [[nodiscard]] Number chi(Axis a, Axis b) const noexcept {
    return a == b ? x_ * second(a) - at(a) * area(a) : x_ * log_s() - r_;
  }
  [[nodiscard]] Number chi(Axis a, Axis b, Axis c) const noexcept {
    if (a == b && b == c) return at(across(a)) / (r_ + x_) - area(a);
    // One of the axes twice, and that one is left.
    return -at(a == b || a == c ? a : b) / (r_ + x_);
  }

 private:
  [[nodiscard]] const Number& y() const noexcept { return at_[0]; }
  [[nodiscard]] const Number& z() const noexcept { return at_[1]; }
  [[nodiscard]] const Number& at(Axis a) const noexcept { return at_[a == Axis::y ? 0 : 1]; }
  [[nodiscard]] const Number& square(Axis a) const noexcept {
    return square_[a == Axis::y ? 0 : 1];
  }

  /// -phi_xx, over y and z.
  [[nodiscard]] Number angle() const noexcept {
    using std::atan2;
    return atan2(y() * z(), x_ * r_);
  }
  /// phi_xa.
  [[nodiscard]] Number area(Axis a) const noexcept {
    using std::asinh;
    using std::sqrt;
    return asinh(at(across(a)) / sqrt(square(a)));
  }
  /// phi_aa, with R - x = (y^2 + z^2) / (R + x).
  [[nodiscard]] Number second(Axis a) const noexcept {
    using std::atan2;
    const Number s = at(a);
    const Number t = at(across(a));
    return atan2(s * t * (s * s + t * t) / (r_ + x_), s * s * r_ + x_ * t * t);
  }
  [[nodiscard]] Number log_s() const noexcept {
    using std::log;
    return log(r_ + x_);
  }

  Number x_;
  Number at_[2];      // y, z
  Number square_[2];  // x^2 + y^2, x^2 + z^2
  Number r_;
};

}  // namespace tactile_net
