#include "control/circulant.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactile_net {
namespace {

/// Sum over the circle of values at 0 ... m/2, continued with even (sign 1) or odd parity:
///
///     v_0 + 2 sum v_l cos(2 pi k l / m) + v_{m/2} cos(pi k), or -2 sum v_l sin(2 pi k l / m)
///
/// for k < count. Its own inverse but for a factor m. By direct sums in long double: plans are made
/// without an FFT, and to the last bit.
std::vector<long double> circle_sums(const std::vector<long double>& values, int sign,
                                     std::size_t count) {
  const std::size_t half = values.size() - 1;
  const std::size_t m = 2 * half;
  std::vector<long double> wave(m);
  for (std::size_t j = 0; j < m; ++j) {
    const long double angle = 2.0L * std::numbers::pi_v<long double> * static_cast<long double>(j) /
                              static_cast<long double>(m);
    wave[j] = sign > 0 ? std::cos(angle) : -std::sin(angle);
  }
  std::vector<long double> sums(count);
  for (std::size_t k = 0; k < count; ++k) {
    long double sum = 0.0L;
    for (std::size_t l = 1; l < half; ++l) sum += values[l] * wave[k * l % m];
    sums[k] = 2.0L * sum;
    if (sign > 0) sums[k] += values[0] + (k % 2 == 0 ? values[half] : -values[half]);
  }
  return sums;
}

}  // namespace

std::size_t transform_size(std::size_t least) noexcept {
  for (std::size_t power = 1;; power *= 2)
    for (const std::size_t factor : {4U, 5U, 6U})
      if (factor * power >= least && factor * power % 2 == 0) return factor * power;
}

std::vector<double> circulant_spectrum(const Eigen::MatrixXd& block, int sign, std::size_t size) {
  const std::size_t n = static_cast<std::size_t>(block.rows());
  const std::size_t half = size / 2;
  std::vector<long double> lags(half + 1, 0.0L);
  for (std::size_t lag = 0; lag <= std::min(half, n - 1); ++lag) {
    const auto at = [&](std::size_t column) {
      return static_cast<long double>(
          block(static_cast<Eigen::Index>(column + lag), static_cast<Eigen::Index>(column)));
    };
    const std::size_t left = n - 1 - lag;
    lags[lag] = 0.5L * (at(left / 2) + at(left - left / 2));
  }
  const std::vector<long double> spectrum = circle_sums(lags, sign, half + 1);
  return {spectrum.begin(), spectrum.end()};
}

Eigen::MatrixXd circulant_corner(const std::vector<double>& spectrum, int sign, Eigen::Index n) {
  const std::size_t size = 2 * (spectrum.size() - 1);
  const std::vector<long double> lags =
      circle_sums({spectrum.begin(), spectrum.end()}, sign, static_cast<std::size_t>(n));
  Eigen::MatrixXd corner(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto lag = static_cast<double>(lags[static_cast<std::size_t>(std::abs(i - j))] /
                                           static_cast<long double>(size));
      corner(i, j) = i >= j ? lag : sign * lag;
    }
  return corner;
}

}  // namespace tactile_net
