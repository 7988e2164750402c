/// @file
/// Problems, readings and products that several tests of skins share.
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/euclidean.hpp"

namespace tactile_net {

inline const std::vector<Quantity> press_and_drag{Quantity::stress_x, Quantity::shear_xy,
                                                  Quantity::shear_xz};
inline const Material silicone{.youngs_modulus = 2e5, .poisson_ratio = 0.45};

/// Of a square lattice, 1 mm apart and `depth` deep.
inline SkinArray square_skin(std::size_t count, double depth,
                             std::vector<Quantity> reads = press_and_drag) {
  return {.rows = count,
          .columns = count,
          .pitch_y = 1e-3,
          .pitch_z = 1e-3,
          .depths = {depth},
          .reads = std::move(reads)};
}

/// One to three ellipses over the middle of that skin, dragged by as much as 0.6 of their pressure.
inline std::vector<SkinLoad> random_contacts(std::mt19937& random, double half_width) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<SkinLoad> loads(1 + static_cast<std::size_t>(3.0 * unit(random)));
  for (SkinLoad& load : loads) {
    const double a = 1e-3 * (1.5 + 2.5 * unit(random));
    const double b = a * (0.6 + 0.4 * unit(random));
    load = SkinContact{.shape = SkinShape::ellipsoid,
                       .y = 0.75 * half_width * (2.0 * unit(random) - 1.0),
                       .z = 0.75 * half_width * (2.0 * unit(random) - 1.0),
                       .radius = a,
                       .second_radius = b,
                       .angle = 3.14 * unit(random),
                       .force = 1e4 * (0.5 + unit(random)) * a * b,
                       .friction = 0.6 * unit(random),
                       .direction = 6.28 * unit(random)};
  }
  return loads;
}

inline std::vector<double> product(const Matrix& matrix, std::span<const double> x) {
  std::vector<double> y(matrix.rows);
  for (std::size_t i = 0; i < matrix.rows; ++i)
    for (std::size_t j = 0; j < matrix.columns; ++j) y[i] += matrix(i, j) * x[j];
  return y;
}

inline std::vector<double> random_numbers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> all(count);
  for (double& one : all) one = normal(random);
  return all;
}

/// Adds white noise. @return  its rms, a share of the largest reading
inline double add_noise(std::vector<double>& readings, double share, std::mt19937& random) {
  double largest = 0.0;
  for (const double reading : readings) largest = std::max(largest, std::abs(reading));
  std::normal_distribution<double> noise(0.0, share * largest);
  for (double& reading : readings) reading += noise(random);
  return share * largest;
}

}  // namespace tactile_net
