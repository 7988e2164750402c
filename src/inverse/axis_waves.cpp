#include "inverse/axis_waves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactile_net {

using Eigen::Index;

Eigen::MatrixXd axis_waves(std::size_t count, std::size_t waves, Boundary boundary) {
  const auto n = static_cast<Index>(count);
  const bool sines = boundary == Boundary::zero_beyond;
  const Index steps = sines ? 2 * (n + 1) : 4 * n;  // in a turn
  Eigen::VectorXd turned(steps);
  for (Index step = 0; step < steps; ++step) {
    const double phase = std::numbers::pi * static_cast<double>(step) /
                         (sines ? static_cast<double>(n + 1) : 2.0 * static_cast<double>(n));
    turned(step) = sines ? std::sin(phase) : std::cos(phase);
  }
  Eigen::MatrixXd columns(n, static_cast<Index>(waves));
  for (Index m = 0; m < columns.cols(); ++m) {
    const double size = sines ? std::sqrt(2.0 / static_cast<double>(n + 1))
                              : std::sqrt((m == 0 ? 1.0 : 2.0) / static_cast<double>(n));
    for (Index i = 0; i < n; ++i) {
      const Index mirrored = n - 1 - i;
      const double sign = mirrored < i && m % 2 == 1 ? -1.0 : 1.0;
      const Index near = std::min(i, mirrored);
      const bool zero = m % 2 == 1 && mirrored == i;  // the middle of an odd wave
      const Index at = (sines ? (m + 1) * (near + 1) : m * (2 * near + 1)) % steps;
      columns(i, m) = zero ? 0.0 : sign * size * turned(at);
    }
  }
  return columns;
}

double roughness(std::size_t m, std::size_t count, Boundary boundary) {
  const std::size_t shift = boundary == Boundary::zero_beyond ? 1 : 0;
  const double half = std::sin(0.5 * std::numbers::pi * static_cast<double>(m + shift) /
                               static_cast<double>(count + shift));
  return 4.0 * half * half;
}

}  // namespace tactile_net
