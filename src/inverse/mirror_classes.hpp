/// @file
/// The classes into which reflections y -> -y and z -> -z part a problem. Private.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <optional>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// Of each reading the one that a reflection makes of it; absent: not every one has its like.
using MirroredReadings = std::optional<std::vector<std::size_t>>;
/// Of y -> -y or z -> -z. What is odd changes its sign besides.
[[nodiscard]] MirroredReadings mirrored_readings(const LinearProblem& problem, Axis along);

/// Of y and z exchanged, of a grid that is the same along both.
[[nodiscard]] MirroredReadings exchanged_readings(const LinearProblem& problem);

/// One class: combinations of readings, and the waves that show in no other one's.
struct MirrorClass {
  Eigen::SparseMatrix<double, Eigen::RowMajor> readings;  ///< orthonormal rows, of W g
  std::vector<Eigen::Index> waves;                        ///< columns of W K in waves
};

/// One where nothing mirrors itself, else two or four, but those of which there is nothing.
[[nodiscard]] std::vector<MirrorClass> mirror_classes(const LinearProblem& problem);

/// The kernel's columns as rows, of the readings of a class: half as many numbers or a quarter,
/// before they are parted into waves.
[[nodiscard]] Eigen::MatrixXd folded_kernel(const Eigen::Ref<const RowMajor>& kernel,
                                            const MirrorClass& part);

/// All readings, and so many coordinates.
[[nodiscard]] MirrorClass whole_class(const LinearProblem& problem, Eigen::Index coordinates);

}  // namespace tactile_net
