/// @file
/// Coordinates of tractions, f = T c, in which the stabiliser is |c|^2. Private.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

class TractionCoordinates {
 public:
  TractionCoordinates() = default;
  TractionCoordinates(const TractionCoordinates&) = delete;
  TractionCoordinates& operator=(const TractionCoordinates&) = delete;
  virtual ~TractionCoordinates() = default;

  [[nodiscard]] virtual Eigen::Index count() const noexcept = 0;
  /// Of tractions.
  [[nodiscard]] virtual Eigen::Index traction_count() const noexcept = 0;
  /// T c, column by column.
  [[nodiscard]] virtual Eigen::MatrixXd tractions(const Eigen::MatrixXd& coordinates) const = 0;
  /// T' f, column by column. A matrix that is handed over is not copied.
  [[nodiscard]] virtual Eigen::MatrixXd sums(Eigen::MatrixXd tractions) const = 0;
  /// These rows of that, a mirror class's coordinates (mirror_classes.hpp).
  [[nodiscard]] virtual Eigen::MatrixXd sums_of(std::span<const Eigen::Index> rows,
                                                Eigen::MatrixXd tractions) const {
    return sums(std::move(tractions))(std::vector<Eigen::Index>(rows.begin(), rows.end()),
                                      Eigen::indexing::all);
  }
  /// The diagonal of T T'.
  [[nodiscard]] virtual Eigen::VectorXd squares() const = 0;
  /// The same of normal tractions summed over a window around each cell.
  [[nodiscard]] virtual Eigen::VectorXd squares(const SurfaceGrid& grid,
                                                const CellWindow& window) const = 0;
  /// Tractions of a component, if T T' joins none of two components; 0: it may.
  [[nodiscard]] virtual Eigen::Index component_size() const noexcept = 0;
  /// What L stretches each coordinate by, where T is a rotation but for that; empty: it is not.
  [[nodiscard]] virtual Eigen::VectorXd stretch() const { return {}; }
};

/// Waves along y and z (axis_waves.hpp), wave (m, n) of component u at the place of value (m, n):
/// C, orthonormal, and T = C / stretch.
class WaveCoordinates final : public TractionCoordinates {
 public:
  /// @param stretch  one number > 0 per wave
  WaveCoordinates(const LinearProblem& problem, Eigen::VectorXd stretch);

  [[nodiscard]] Eigen::Index count() const noexcept override { return stretch_.size(); }
  [[nodiscard]] Eigen::Index traction_count() const noexcept override { return stretch_.size(); }
  [[nodiscard]] Eigen::MatrixXd tractions(const Eigen::MatrixXd& coordinates) const override;
  [[nodiscard]] Eigen::MatrixXd sums(Eigen::MatrixXd tractions) const override;
  /// Works out no others.
  /// @pre  of each component every one of some waves along y with every one of some along z, in
  ///       order
  [[nodiscard]] Eigen::MatrixXd sums_of(std::span<const Eigen::Index> rows,
                                        Eigen::MatrixXd tractions) const override;
  [[nodiscard]] Eigen::VectorXd squares() const override;
  [[nodiscard]] Eigen::VectorXd squares(const SurfaceGrid& grid,
                                        const CellWindow& window) const override;
  [[nodiscard]] Eigen::Index component_size() const noexcept override {
    return y_.rows() * z_.rows();
  }
  [[nodiscard]] Eigen::VectorXd stretch() const override { return stretch_; }

  /// stretch C' f: the coordinates of tractions.
  [[nodiscard]] Eigen::MatrixXd coordinates(const Eigen::MatrixXd& tractions) const;
  /// C (stretch c): the transposed of that.
  [[nodiscard]] Eigen::MatrixXd spread(const Eigen::MatrixXd& coordinates) const;

 private:
  Eigen::MatrixXd y_, z_;  // waves along each axis, a column each
  Eigen::VectorXd stretch_;
};

/// The eigenvalues of L'L, one per wave.
[[nodiscard]] Eigen::VectorXd stabiliser_spectrum(const LinearProblem& problem);
/// The same with another tangential weight.
[[nodiscard]] Eigen::VectorXd stabiliser_spectrum(const LinearProblem& problem,
                                                  double tangential_weight);

}  // namespace tactile_net
