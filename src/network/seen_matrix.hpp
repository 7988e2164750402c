/// @file
/// What currents at the summing nodes of a build see of it: its equations, all but the outputs
/// eliminated. Private.
#pragma once

#include "numeric/eigen.hpp"
#include "tactile_net/network/reduction.hpp"

namespace tactile_net {

/// The rows of S: outputs, residuals, each with itself alone, and of a lattice the voltages that
/// both inputs of an amplifier have.
struct SeenSizes {
  Eigen::Index outputs = 0, residuals = 0, common = 0;
};

/// The blocks of S with the op-amps' finite gain, of one set of conductances.
class SeenMatrix {
 public:
  /// @param lossy  1 over the op-amps' gain; 0: infinite
  SeenMatrix(const Reduction& reduction, const Equations& equations, const SeenSizes& sizes,
             double lossy);

  [[nodiscard]] const Eigen::MatrixXd& matrix() const noexcept { return seen_; }  ///< [S]
  /// What the sources are at the outputs' rows [A].
  [[nodiscard]] const Eigen::VectorXd& driven() const noexcept { return driven_; }

  /// L and R of the first order d(seen) = L dS R: a column a row of S, a row an unknown.
  [[nodiscard]] Eigen::MatrixXd rows() const;
  [[nodiscard]] Eigen::MatrixXd unknowns() const;
  /// L'x and R x.
  [[nodiscard]] Eigen::VectorXd rows(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd unknowns(const Eigen::VectorXd& x) const;

  // Blocks, named after rows and columns: outputs, residuals, common.
  Eigen::MatrixXd oo, on, oc, no, nc, co, cn, cc;
  Eigen::VectorXd held;  ///< the residuals' diagonal

 private:
  // Without residuals; and then without the common voltages.
  Eigen::MatrixXd oc_, co_, inverse_;  // inverse: of the common block
  Eigen::MatrixXd seen_;
  Eigen::VectorXd driven_;
};

}  // namespace tactile_net
