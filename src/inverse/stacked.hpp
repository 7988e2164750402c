/// @file
/// Least squares of stacked matrices by QR, shared by `tikhonov` and `closed_form`. Private.
#pragma once

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "inverse/eigen.hpp"
#include "inverse/stabiliser.hpp"
#include "tactile_net/inverse/problem.hpp"

namespace tactile_net {

inline void check_alpha(double alpha) {
  if (!(alpha > 0.0) || !std::isfinite(alpha))
    throw std::invalid_argument("alpha must be > 0 and finite");
}

/// [W K; sqrt(alpha) L].
[[nodiscard]] inline Eigen::MatrixXd stacked(const InverseProblem& problem, double alpha) {
  const auto kernel = as_eigen(problem.kernel);
  Eigen::MatrixXd a(kernel.rows() + 2 * kernel.cols(), kernel.cols());
  a.topRows(kernel.rows()) = kernel;
  a.bottomRows(2 * kernel.cols()) = std::sqrt(alpha) * stabiliser(problem);
  return a;
}

/// QR of a tall matrix. Rows should be stacked largest first: Householder reflections are then
/// stable row by row, however small alpha makes the lower ones.
class StackedQr {
  [[nodiscard]] auto triangle() const {
    return qr_.matrixQR().topRows(unknowns()).triangularView<Eigen::Upper>();
  }

 public:
  explicit StackedQr(const Eigen::MatrixXd& stacked) : qr_(stacked) {}

  [[nodiscard]] Eigen::Index unknowns() const { return qr_.cols(); }

  /// Q' x, of full length: the first `unknowns()` entries solve, the rest is the residual.
  template <class Right>
  [[nodiscard]] Eigen::MatrixXd rotate(const Right& right) const {
    return qr_.householderQ().adjoint() * right;
  }

  /// Q x for x of full length.
  [[nodiscard]] Eigen::MatrixXd rotate_back(const Eigen::MatrixXd& x) const {
    return qr_.householderQ() * x;
  }

  /// The least-squares solution for a rotated right side.
  [[nodiscard]] Eigen::MatrixXd solve_rotated(const Eigen::MatrixXd& rotated) const {
    return triangle().solve(rotated.topRows(unknowns()));
  }

  /// 2-norm condition number.
  /// @throw std::domain_error  it exceeds what double precision can resolve
  [[nodiscard]] double condition() const {
    return checked_condition(Eigen::BDCSVD<Eigen::MatrixXd>(square()).singularValues());
  }

  /// The first `rows` columns of the pseudo-inverse, and the condition number.
  ///
  /// By a singular value decomposition of the triangle. Solving with the triangle would give each
  /// column an error of kappa times its own size, kappa^2 in all: here the factors' errors stay
  /// orthogonal to it, and a product with readings loses kappa alone.
  ///
  /// @throw std::domain_error  as `condition`
  [[nodiscard]] std::pair<Eigen::MatrixXd, double> pseudo_inverse(Eigen::Index rows) const {
    const Eigen::BDCSVD<Eigen::MatrixXd> svd(square(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double condition = checked_condition(svd.singularValues());
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(qr_.rows(), unknowns());
    u.topRows(unknowns()) = svd.matrixU();
    u.applyOnTheLeft(qr_.householderQ());
    return {svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal() *
                u.topRows(rows).transpose(),
            condition};
  }

 private:
  [[nodiscard]] Eigen::MatrixXd square() const {
    Eigen::MatrixXd r = Eigen::MatrixXd::Zero(unknowns(), unknowns());
    r.triangularView<Eigen::Upper>() = qr_.matrixQR().topRows(unknowns());
    return r;
  }

  [[nodiscard]] double checked_condition(const Eigen::VectorXd& s) const {
    const double limit =
        1.0 / (std::numeric_limits<double>::epsilon() * static_cast<double>(qr_.rows()));
    const double condition = s(0) / s(s.size() - 1);
    if (!(condition < limit)) {
      std::ostringstream text;
      text << "rank deficient in double precision: condition number " << condition
           << " of the stacked matrix, limit " << limit << "; raise alpha";
      throw std::domain_error(text.str());
    }
    return condition;
  }

  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
};

/// M W: a pseudo-inverse of weighted rows, applied to readings that are not weighted yet.
[[nodiscard]] inline Matrix unweighted(const Eigen::MatrixXd& inverse,
                                       const InverseProblem& problem) {
  return from_eigen(inverse * as_eigen(std::span(problem.weights)).asDiagonal());
}

}  // namespace tactile_net
