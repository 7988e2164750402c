/// @file
/// Coordinates of tractions, f = T c, in which the stabiliser is |c|^2. Private.
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "numeric/eigen.hpp"
#include "numeric/sparse_cholesky.hpp"
#include "tactile_net/skin/cell_window.hpp"
#include "tactile_net/skin/cone.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

class SkinCoordinates {
 public:
  SkinCoordinates() = default;
  SkinCoordinates(const SkinCoordinates&) = delete;
  SkinCoordinates& operator=(const SkinCoordinates&) = delete;
  virtual ~SkinCoordinates() = default;

  [[nodiscard]] virtual Eigen::Index count() const noexcept = 0;
  /// Of tractions.
  [[nodiscard]] virtual Eigen::Index traction_count() const noexcept = 0;
  /// T c, column by column.
  [[nodiscard]] virtual Eigen::MatrixXd tractions(const Eigen::MatrixXd& coordinates) const = 0;
  /// T' f, column by column. A matrix that is handed over is not copied.
  [[nodiscard]] virtual Eigen::MatrixXd sums(Eigen::MatrixXd tractions) const = 0;
  /// The diagonal of T T'.
  [[nodiscard]] virtual Eigen::VectorXd squares() const = 0;
  /// The same of normal tractions summed over a window around each cell.
  [[nodiscard]] virtual Eigen::VectorXd squares(const SkinGrid& grid,
                                                const CellWindow& window) const = 0;
  /// Tractions of a component, if T T' joins none of two components; 0: it may.
  [[nodiscard]] virtual Eigen::Index component_size() const noexcept = 0;
};

/// Cosines along y and z, wave (m, n) of component u at the place of cell (m, n): C, orthonormal,
/// and T = C / stretch.
class CosineCoordinates final : public SkinCoordinates {
 public:
  /// @param stretch  one number > 0 per wave
  CosineCoordinates(const SkinProblem& problem, Eigen::VectorXd stretch);

  [[nodiscard]] Eigen::Index count() const noexcept override { return stretch_.size(); }
  [[nodiscard]] Eigen::Index traction_count() const noexcept override { return stretch_.size(); }
  [[nodiscard]] Eigen::MatrixXd tractions(const Eigen::MatrixXd& coordinates) const override;
  [[nodiscard]] Eigen::MatrixXd sums(Eigen::MatrixXd tractions) const override;
  [[nodiscard]] Eigen::VectorXd squares() const override;
  [[nodiscard]] Eigen::VectorXd squares(const SkinGrid& grid,
                                        const CellWindow& window) const override;
  [[nodiscard]] Eigen::Index component_size() const noexcept override {
    return y_.rows() * z_.rows();
  }

  /// stretch C' f: the coordinates of tractions.
  [[nodiscard]] Eigen::MatrixXd coordinates(const Eigen::MatrixXd& tractions) const;
  /// C (stretch c): the transposed of that.
  [[nodiscard]] Eigen::MatrixXd spread(const Eigen::MatrixXd& coordinates) const;

 private:
  Eigen::MatrixXd y_, z_;  // waves along each axis, a column each
  Eigen::VectorXd stretch_;
};

/// The eigenvalues of L'L, one per wave.
[[nodiscard]] Eigen::VectorXd stabiliser_spectrum(const SkinProblem& problem);
/// The same with another tangential weight.
[[nodiscard]] Eigen::VectorXd stabiliser_spectrum(const SkinProblem& problem,
                                                  double tangential_weight);

/// Of what a face of the cones leaves free, T = E R^-1 with E its directions and R'R = E' L'L E.
/// Each direction lies in one cell and L'L joins neighbours, so that R is sparse. It comes from
/// L'L, whose condition is the square of L's: a few hundred at most while cells are no narrower
/// than a twentieth of the smoothing length, whatever the tangential weight, which scales columns.
/// Where they are narrower than `too_narrow` of it, R comes from a QR of L E.
class FaceCoordinates final : public SkinCoordinates {
 public:
  static constexpr double too_narrow = 1e-3;

  /// @throw std::invalid_argument  nothing is free, or the face is of another problem
  FaceCoordinates(const SkinProblem& problem, const ActiveFace& face);

  [[nodiscard]] Eigen::Index count() const noexcept override { return edges_.cols(); }
  [[nodiscard]] Eigen::Index traction_count() const noexcept override { return edges_.rows(); }
  [[nodiscard]] Eigen::MatrixXd tractions(const Eigen::MatrixXd& coordinates) const override;
  [[nodiscard]] Eigen::MatrixXd sums(Eigen::MatrixXd tractions) const override;
  [[nodiscard]] Eigen::VectorXd squares() const override;
  [[nodiscard]] Eigen::VectorXd squares(const SkinGrid& grid,
                                        const CellWindow& window) const override;
  [[nodiscard]] Eigen::Index component_size() const noexcept override { return 0; }

 private:
  Eigen::SparseMatrix<double> edges_;  // E
  std::optional<SparseCholesky> root_{};
  Eigen::MatrixXd triangle_{};  // R, where it is not sparse
};

}  // namespace tactile_net
