#include "inverse/stacked.hpp"

#include <Eigen/QR>
#include <limits>
#include <sstream>

#include "inverse/decompositions.hpp"

namespace tactile_net {

struct StackedQr::Factors : Eigen::HouseholderQR<Eigen::MatrixXd> {
  using HouseholderQR::HouseholderQR;

  [[nodiscard]] double checked_condition(const Eigen::VectorXd& s) const {
    const double limit =
        1.0 / (std::numeric_limits<double>::epsilon() * static_cast<double>(rows()));
    const double condition = s(0) / s(s.size() - 1);
    if (!(condition < limit)) {
      std::ostringstream text;
      text << "rank deficient in double precision: condition number " << condition
           << " of the stacked matrix, limit " << limit << "; raise alpha";
      throw std::domain_error(text.str());
    }
    return condition;
  }
};

StackedQr::StackedQr(const Eigen::MatrixXd& stacked)
    : factors_(std::make_unique<const Factors>(stacked)) {}
StackedQr::~StackedQr() = default;

Eigen::Index StackedQr::unknowns() const noexcept { return factors_->cols(); }

Eigen::MatrixXd StackedQr::rotate(const Eigen::MatrixXd& right) const {
  return factors_->householderQ().adjoint() * right;
}

Eigen::MatrixXd StackedQr::rotate_back(const Eigen::MatrixXd& x) const {
  return factors_->householderQ() * x;
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
