/// @file
/// Bessel functions without their zero at the origin. Private.
#pragma once

#include <array>
#include <boost/math/special_functions/bessel.hpp>
#include <cstddef>

namespace tactile_net {

/// J_j(x) / x^j for j = 0 ... 3.
inline std::array<double, 4> reduced_bessel(double x) {
  if (x > 2.0) {
    using Plain = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
    const double j0 = boost::math::cyl_bessel_j(0, x, Plain{});
    const double j1 = boost::math::cyl_bessel_j(1, x, Plain{});
    const double j2 = 2.0 * j1 / x - j0;
    const double j3 = 4.0 * j2 / x - j1;
    return {j0, j1 / x, j2 / (x * x), j3 / (x * x * x)};
  }
  std::array<double, 4> sums{};
  double first = 1.0;  // 1 / (2^j j!)
  for (std::size_t j = 0; j < sums.size(); ++j) {
    if (j > 0) first /= 2.0 * static_cast<double>(j);
    double term = first;
    for (int m = 1; m <= 14; ++m) {
      sums[j] += term;
      term *= -0.25 * x * x / (m * (m + static_cast<double>(j)));
    }
  }
  return sums;
}

}  // namespace tactile_net
