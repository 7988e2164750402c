/// @file
/// Student's distribution function of a whole number of degrees, as often as a mixture asks for it:
/// a tenth of the time of its series. Private.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tactile_net {

/// Student's cdf of a whole number of degrees: a sum of degrees / 2 terms that do not cancel
/// (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4). Its error is absolute, 1e-15.
[[nodiscard]] double student_series(int degrees, double t);

/// The same from a table: between two places a 32nd apart the polynomial of fifth order with the
/// function's values, slopes and curvatures there. The next term of its error is
/// (1/32)^6 / 46080 times the sixth derivative: 1e-12.
class StudentCdf {
 public:
  /// @param degrees  >= 1
  explicit StudentCdf(int degrees);
  /// One for each number of degrees, made once. Several threads may ask.
  [[nodiscard]] static const StudentCdf& of(int degrees);

  /// Beyond the table by the series.
  [[nodiscard]] double operator()(double t) const;

  /// F, and how fast it rises.
  struct Rise {
    double value = 0.0, slope = 0.0;
  };
  /// The polynomial and its slope. @pre  |t| < end()
  [[nodiscard]] Rise rise(double t) const {
    const double place = std::abs(t) * pieces_in_one;
    const auto piece = static_cast<std::size_t>(place);
    const auto& [a, b, c, d, e, f] = pieces_[piece];
    const double x = place - static_cast<double>(piece);
    const double above = a + x * (b + x * (c + x * (d + x * (e + x * f))));
    const double slope = b + x * (2.0 * c + x * (3.0 * d + x * (4.0 * e + x * 5.0 * f)));
    return {t < 0.0 ? 1.0 - above : above, pieces_in_one * slope};
  }
  /// Where the table ends: where the rest is no longer told from 0, at most 24.
  [[nodiscard]] double end() const noexcept { return end_; }
  /// Whether what lies beyond is less than 1e-17.
  [[nodiscard]] bool holds_all() const noexcept { return end_ < most_reach; }
  /// Beyond, 1 - F is no longer told from F to nine digits.
  static constexpr double reach = 6.0;

 private:
  static constexpr double pieces_in_one = 32.0;
  static constexpr double most_reach = 24.0;

  int degrees_;
  double end_ = 0.0;
  std::vector<std::array<double, 6>> pieces_{};  // of t >= 0
};

}  // namespace tactile_net
