/// @file
/// Student's distribution function of a whole number of degrees, as often as a mixture asks for it:
/// a tenth of the time of its series. Private.
#pragma once

#include <array>
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
  /// |t| below it is tabled: beyond, 1 - F is no longer told from F to nine digits.
  static constexpr double reach = 6.0;

 private:
  int degrees_;
  std::vector<std::array<double, 6>> pieces_{};  // of t >= 0
};

}  // namespace tactile_net
