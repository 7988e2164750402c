/// @file
/// The largest eigenvalue, by power iteration. Private.
#pragma once

#include <cmath>
#include <utility>

#include "numeric/eigen.hpp"

namespace tactile_net {

/// Of a symmetric positive semidefinite P, from below.
///
/// @param x        to begin with: it has a part of the eigenvector
/// @param settled  it ends where a step changes the answer by no more than this share; -1: never
/// @param product  (x): P x
template <class Product>
[[nodiscard]] double power_iteration(Eigen::VectorXd x, int most_steps, double settled,
                                     const Product& product) {
  double largest = 0.0;
  for (int step = 0; step < most_steps; ++step) {
    x.normalize();
    x = product(x);
    const double before = std::exchange(largest, x.norm());
    if (std::abs(largest - before) <= settled * largest) break;
  }
  return largest;
}

}  // namespace tactile_net
