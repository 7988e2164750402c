#include "inverse/stacked.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "numeric/decompositions.hpp"
#include "tactile_net/numeric/number_text.hpp"

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

struct StackedQr::Factors : Eigen::HouseholderQR<Eigen::MatrixXd> {
  explicit Factors(const Eigen::MatrixXd& stacked) : Factors(stacked, sorting(stacked)) {}
  Factors(const Eigen::MatrixXd& stacked, Eigen::PermutationMatrix<Eigen::Dynamic> to)
      : HouseholderQR(to * stacked), sorted(std::move(to)) {}

  [[nodiscard]] double checked_condition(const Eigen::VectorXd& s) const {
    const double limit =
        1.0 / (std::numeric_limits<double>::epsilon() * static_cast<double>(rows()));
    const double condition = s(0) / s(s.size() - 1);
    if (!(condition < limit))
      throw std::domain_error("rank deficient in double precision: condition number " +
                              brief(condition, 6) + " of the stacked matrix, limit " +
                              brief(limit, 6) + "; raise alpha");
    return condition;
  }

  Eigen::PermutationMatrix<Eigen::Dynamic> sorted;
};

StackedQr::StackedQr(const Eigen::MatrixXd& stacked)
    : factors_(std::make_unique<const Factors>(stacked)) {}
StackedQr::~StackedQr() = default;

Eigen::Index StackedQr::unknowns() const noexcept { return factors_->cols(); }

Eigen::MatrixXd StackedQr::rotate(const Eigen::MatrixXd& right) const {
  return factors_->householderQ().adjoint() * (factors_->sorted * right);
}

Eigen::MatrixXd StackedQr::rotate_back(const Eigen::MatrixXd& x) const {
  return factors_->sorted.transpose() * (factors_->householderQ() * x).eval();
}

Eigen::MatrixXd StackedQr::triangle() const {
  return factors_->matrixQR().topRows(unknowns()).triangularView<Eigen::Upper>();
}

Eigen::MatrixXd StackedQr::solve_rotated(const Eigen::MatrixXd& rotated) const {
  return solve_upper(triangle(), rotated.topRows(unknowns()));
}

double StackedQr::condition() const {
  return factors_->checked_condition(singular_values(triangle()));
}

std::pair<Eigen::MatrixXd, double> StackedQr::pseudo_inverse(Eigen::Index rows) const {
  const Svd svd = singular_value_decomposition(triangle());
  const double condition = factors_->checked_condition(svd.values);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(factors_->rows(), unknowns());
  u.topRows(unknowns()) = svd.u;
  const Eigen::MatrixXd rotated = rotate_back(u);
  return {svd.v * svd.values.cwiseInverse().asDiagonal() * rotated.topRows(rows).transpose(),
          condition};
}

}  // namespace tactile_net
