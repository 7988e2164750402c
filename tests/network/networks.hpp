/// @file
/// Matrices that several tests share.
#pragma once

#include <random>
#include <vector>

#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

/// A'A + shift I with entries of both signs: symmetric positive definite, some row sums negative.
inline Matrix random_definite(std::size_t n, unsigned seed, double shift = 0.1) {
  std::mt19937 generator(seed);
  Matrix a{n, n, std::vector<double>(n * n)};
  for (double& value : a.values)
    value = 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0;
  Matrix p{n, n, std::vector<double>(n * n)};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = i == j ? shift : 0.0;
      for (std::size_t k = 0; k < n; ++k) sum += a(k, i) * a(k, j);
      p(i, j) = p(j, i) = sum;
    }
  return p;
}

}  // namespace tactile_net
