/// @file
/// The functions of half_space_field.hpp for a source at an imaginary depth. Private.
#pragma once

#include <complex>

#include "elasticity/space/point_source.hpp"

namespace tactile_net {

/// The table's harmonic functions at x + i t. Where its terms have x as a factor, as in x phi_abc,
/// it stays the real depth of the place, which takes i t phi_abc off.
class ImaginarySource {
  using Complex = std::complex<double>;

 public:
  ImaginarySource(double x, double t, double y, double z) noexcept
      : point_(Complex(x, t), y, z), shift_(0.0, t) {}

  [[nodiscard]] Complex radial(Axis a, Axis b, Axis c) const noexcept {
    return point_.radial(a, b, c) - shift_ * point_.phi_of_three(a, b, c);
  }
  [[nodiscard]] Complex near(Axis a, Axis c) const noexcept {
    return point_.near(a, c) + shift_ * point_.phi(a, c);
  }
  [[nodiscard]] Complex phi(Axis a) const noexcept { return point_.phi(a); }
  [[nodiscard]] Complex phi(Axis a, Axis b) const noexcept { return point_.phi(a, b); }
  [[nodiscard]] Complex chi(Axis a, Axis b) const noexcept { return point_.chi(a, b); }
  [[nodiscard]] Complex chi(Axis a, Axis b, Axis c) const noexcept { return point_.chi(a, b, c); }

 private:
  PointSource<Complex> point_;
  Complex shift_;
};

}  // namespace tactile_net
