/// @file
/// The classes into which reflections y -> -y and z -> -z part a skin's problem. Private.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// One class: combinations of readings, and the waves that show in no other one's.
struct SkinClass {
  Eigen::SparseMatrix<double, Eigen::RowMajor> readings;  ///< orthonormal rows, of W g
  std::vector<Eigen::Index> waves;                        ///< columns of W K in cosines
};

/// One where nothing mirrors itself, else two or four.
[[nodiscard]] std::vector<SkinClass> mirror_classes(const SkinProblem& problem);

/// All readings, and so many coordinates.
[[nodiscard]] SkinClass whole_class(const SkinProblem& problem, Eigen::Index coordinates);

}  // namespace tactile_net
