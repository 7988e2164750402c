/// @file
/// The library's matrices and vectors as Eigen's, to check them by its decompositions.
#pragma once

#include <Eigen/Core>
#include <span>

#include "tactile_net/numeric/matrix.hpp"

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

inline Eigen::Map<const RowMajor> view(const tactile_net::Matrix& matrix) {
  return {matrix.values.data(), static_cast<Eigen::Index>(matrix.rows),
          static_cast<Eigen::Index>(matrix.columns)};
}

inline Eigen::Map<const Eigen::VectorXd> view(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}
