/// @file
/// Coordinates of the tractions that a face of the constraints leaves free. Private.
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "inverse/coordinates.hpp"
#include "numeric/eigen.hpp"
#include "numeric/sparse_cholesky.hpp"
#include "tactile_net/inverse/active_face.hpp"

namespace tactile_net {

/// Of what a face of the constraints leaves free, T = E R^-1 with E its directions and R'R = E' L'L
/// E. Each direction lies in one cell and L'L joins neighbours, so that R is sparse. It comes from
/// L'L, whose condition is the square of L's: a few hundred at most while cells are no narrower
/// than a twentieth of the smoothing length, whatever the tangential weight, which scales columns.
/// Where they are narrower than `too_narrow` of it, R comes from a QR of L E.
class FaceCoordinates final : public TractionCoordinates {
 public:
  static constexpr double too_narrow = 1e-3;

  /// @throw std::invalid_argument  nothing is free, or the face is of another problem
  FaceCoordinates(const LinearProblem& problem, const ActiveFace& face);

  [[nodiscard]] Eigen::Index count() const noexcept override { return edges_.cols(); }
  [[nodiscard]] Eigen::Index traction_count() const noexcept override { return edges_.rows(); }
  [[nodiscard]] Eigen::MatrixXd tractions(const Eigen::MatrixXd& coordinates) const override;
  [[nodiscard]] Eigen::MatrixXd sums(Eigen::MatrixXd tractions) const override;
  [[nodiscard]] Eigen::VectorXd squares() const override;
  [[nodiscard]] Eigen::VectorXd squares(const SurfaceGrid& grid,
                                        const CellWindow& window) const override;
  [[nodiscard]] Eigen::Index component_size() const noexcept override { return 0; }

 private:
  Eigen::SparseMatrix<double> edges_;  // E
  std::optional<SparseCholesky> root_{};
  Eigen::MatrixXd triangle_{};  // R, where it is not sparse
};

}  // namespace tactile_net
