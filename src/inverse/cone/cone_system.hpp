/// @file
/// What a search inside the cones solves: P = K'K + alpha L'L by classes, of which what depends on
/// alpha is made in a fraction of the time that the rest takes. Private.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "inverse/cone/cell_cones.hpp"
#include "inverse/cone/rest_of_rows.hpp"
#include "inverse/coordinates.hpp"
#include "inverse/mirror_classes.hpp"
#include "inverse/weighting.hpp"
#include "numeric/cholesky.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"

namespace tactile_net {

/// Factors that make numbers of K and of both tractions one size; cones stay cones.
struct ConeScales {
  explicit ConeScales(const LinearProblem& problem);

  /// The problem's kernel: the only copy of it.
  [[nodiscard]] RowMajor kernel_of(const LinearProblem& problem) const;
  [[nodiscard]] Constraints applied(Constraints constraints) const;
  [[nodiscard]] double applied(double alpha) const { return alpha / kernel / kernel; }

  double kernel;  // its largest entry
  double drag;    // tangential tractions are multiplied by it
};

/// What systems of all alphas share: in cosines, in which L'L is diagonal, of one size.
struct ConeProblem {
  /// A class: its kernel in cosines, or where there are more readings than waves K'K.
  struct Block {
    std::vector<Eigen::Index> waves{};
    RowMajor kernel{};         // readings x waves; without rows: `square` stands for it
    Eigen::MatrixXd square{};  // K'K
  };

  /// @throw std::invalid_argument  as `ConeTikhonov`
  ConeProblem(const LinearProblem& problem, const Constraints& limits);

  /// K'K c of coordinates.
  [[nodiscard]] Eigen::VectorXd product(const Eigen::VectorXd& c) const;

  ConeScales scales;  // of what has been made one size
  RowLayout rows;
  Weighting weighting;
  Eigen::Index cells;
  std::size_t components;
  double area;
  Constraints constraints;
  RowMajor kernel;
  WaveCoordinates waves;     // orthonormal
  Eigen::VectorXd spectrum;  // of L'L
  std::vector<Block> blocks{};
};

/// P + rho of one alpha. Its condition is at most 1 + sqrt(lambda_max / alpha) / 2, that of the
/// readings stacked on the stabiliser: it is rho that allows for Cholesky's decomposition here.
class ConeSystem {
 public:
  /// Penalty over sqrt(lambda_max alpha): with Anderson's acceleration 1 and 2 take about as many
  /// steps; without it this takes the fewest.
  static constexpr double penalty_share = 2.0;

  /// @param alpha  as the caller has it
  /// @param share  of the penalty, > 0
  /// @throw std::domain_error  alpha is so small that P + rho is not positive definite in doubles
  ConeSystem(std::shared_ptr<const ConeProblem> problem, double alpha,
             double share = penalty_share);

  [[nodiscard]] const ConeProblem& problem() const noexcept { return *problem_; }
  [[nodiscard]] const std::shared_ptr<const ConeProblem>& shared_problem() const noexcept {
    return problem_;
  }
  /// Eigenvalue of P.
  [[nodiscard]] double largest() const noexcept { return largest_; }
  [[nodiscard]] double rho() const noexcept { return rho_; }
  /// Bounds of P's eigenvalues, from above and from below.
  [[nodiscard]] double above_all() const;
  [[nodiscard]] double below_all() const { return smoothing_.minCoeff(); }
  /// (P + rho)^-1 x, of tractions.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& x) const;
  /// P x.
  [[nodiscard]] Eigen::VectorXd product(const Eigen::VectorXd& x) const;

 private:
  /// Of a class: with D = alpha L'L + rho, of K'K + D, or of 1 + K D^-1 K'.
  [[nodiscard]] Eigen::MatrixXd inverse(const ConeProblem::Block& block) const;

  std::shared_ptr<const ConeProblem> problem_;
  Eigen::VectorXd smoothing_;  // alpha L'L
  double largest_;
  double rho_;
  std::vector<Eigen::MatrixXd> inverses_{};
};

}  // namespace tactile_net
