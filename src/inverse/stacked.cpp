#include "inverse/stacked.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "tactile_net/inverse/error_bound.hpp"

namespace tactile_net {

namespace {

/// Where each row goes: the largest first.
Eigen::PermutationMatrix<Eigen::Dynamic> sorting(const Eigen::MatrixXd& rows) {
  const Eigen::VectorXd sizes = rows.cwiseAbs().rowwise().maxCoeff();
  std::vector<int> order(static_cast<std::size_t>(rows.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sizes(a) > sizes(b); });
  Eigen::PermutationMatrix<Eigen::Dynamic> to(rows.rows());
  for (std::size_t place = 0; place < order.size(); ++place)
    to.indices()(order[place]) = static_cast<int>(place);
  return to;
}

}  // namespace

StackedQr::StackedQr(const Eigen::MatrixXd& stacked)
    : sorted_(sorting(stacked)), factors_(sorted_ * stacked) {}

double StackedQr::checked_condition(const Eigen::VectorXd& s) const {
  const double condition = s(0) / s(s.size() - 1);
  require_full_rank(condition, static_cast<std::size_t>(factors_.rows()));
  return condition;
}

Eigen::MatrixXd StackedQr::rotate(const Eigen::MatrixXd& right) const {
  return factors_.rotate(sorted_ * right);
}

Eigen::MatrixXd StackedQr::rotate_back(const Eigen::MatrixXd& x) const {
  return sorted_.transpose() * factors_.rotate_back(x);
}

Eigen::MatrixXd StackedQr::solve_rotated(const Eigen::MatrixXd& rotated) const {
  return solve_upper(triangle(), rotated.topRows(unknowns()));
}

double StackedQr::condition() const { return checked_condition(singular_values(triangle())); }

std::pair<Eigen::MatrixXd, double> StackedQr::pseudo_inverse(Eigen::Index rows) const {
  const Svd svd = singular_value_decomposition(triangle());
  const double condition = checked_condition(svd.values);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(factors_.rows(), unknowns());
  u.topRows(unknowns()) = svd.u;
  const Eigen::MatrixXd rotated = rotate_back(u);
  return {svd.v * svd.values.cwiseInverse().asDiagonal() * rotated.topRows(rows).transpose(),
          condition};
}

}  // namespace tactile_net
