/// @file
/// A pair (K, L) in the basis where Tikhonov's method is diagonal. Private.
#pragma once

#include <utility>

#include "inverse/line_stabiliser.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

/// Generalised singular values and vectors of (K, L): with the triangle R of a QR of L, whose
/// columns are independent and well conditioned, K R^-1 = U diag(gamma) V'. Nothing is squared.
struct StandardForm {
  /// @param r  the triangle of L
  StandardForm(const Eigen::MatrixXd& k, Eigen::MatrixXd r) : triangle(std::move(r)) {
    Svd svd = singular_value_decomposition(divide_upper(k, triangle));
    u = std::move(svd.u);
    v = std::move(svd.v);
    gamma = std::move(svd.values);
  }
  explicit StandardForm(const LinearProblem& problem)
      : StandardForm(as_eigen(problem.kernel), stabiliser_triangle(problem)) {}

  /// Of the variables z that constraints leave free, f = E z (constrained.hpp).
  ///
  /// @param free_edges  the columns of E that they are
  StandardForm(const LinearProblem& problem, const Eigen::MatrixXd& free_edges)
      : StandardForm(as_eigen(problem.kernel) * free_edges,
                     HouseholderQr(stabiliser(problem) * free_edges).triangle()) {
    edges = free_edges;
  }

  /// R^-1 x, as tractions.
  [[nodiscard]] Eigen::MatrixXd tractions_of(const Eigen::MatrixXd& x) const {
    const Eigen::MatrixXd z = solve_upper(triangle, x);
    return edges.size() > 0 ? edges * z : z;
  }

  /// R^-1 V y: from components to tractions.
  template <class Components>
  [[nodiscard]] Eigen::MatrixXd from_components(const Components& y) const {
    return tractions_of(v * y);
  }

  Eigen::MatrixXd edges;     // E; empty: tractions are the variables
  Eigen::MatrixXd triangle;  // R
  Eigen::MatrixXd u, v;
  Eigen::VectorXd gamma;  // descending
};

}  // namespace tactile_net
