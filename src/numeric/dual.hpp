/// @file
/// Numbers that carry their derivatives along: forward differentiation without truncation. Private.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace tactile_net {

/// A value and its derivatives by N seeds. What is needed of a formula's arithmetic, no more.
///
///     const Dual<1> x = Dual<1>::seed(2.0, 0);
///     (x * exp(x)).slope[0]                      // (1 + 2) exp(2)
template <std::size_t N>
struct Dual {
  double value = 0.0;
  std::array<double, N> slope{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: a number is a dual one

  [[nodiscard]] static Dual seed(double value, std::size_t index) {
    Dual result(value);
    result.slope[index] = 1.0;
    return result;
  }
  /// f(value) with f' there.
  [[nodiscard]] Dual chained(double image, double derivative) const {
    Dual result(image);
    for (std::size_t i = 0; i < N; ++i) result.slope[i] = derivative * slope[i];
    return result;
  }

  friend Dual operator-(const Dual& a) { return a.chained(-a.value, -1.0); }
  friend Dual operator+(Dual a, const Dual& b) {
    a.value += b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] += b.slope[i];
    return a;
  }
  friend Dual operator-(Dual a, const Dual& b) {
    a.value -= b.value;
    for (std::size_t i = 0; i < N; ++i) a.slope[i] -= b.slope[i];
    return a;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual result(a.value * b.value);
    for (std::size_t i = 0; i < N; ++i)
      result.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
    return result;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual result(a.value / b.value);
    for (std::size_t i = 0; i < N; ++i)
      result.slope[i] = (a.slope[i] - result.value * b.slope[i]) / b.value;
    return result;
  }
  friend Dual exp(const Dual& a) {
    const double image = std::exp(a.value);
    return a.chained(image, image);
  }
  friend Dual expm1(const Dual& a) { return a.chained(std::expm1(a.value), std::exp(a.value)); }
  friend Dual log1p(const Dual& a) { return a.chained(std::log1p(a.value), 1.0 / (1.0 + a.value)); }
};

/// A number without its derivatives.
[[nodiscard]] inline double plain(double number) { return number; }
template <std::size_t N>
[[nodiscard]] double plain(const Dual<N>& number) {
  return number.value;
}

}  // namespace tactile_net
