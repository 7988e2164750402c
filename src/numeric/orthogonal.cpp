#include <Eigen/QR>

#include "numeric/decompositions.hpp"

namespace tactile_net {

struct HouseholderQr::Factors : Eigen::HouseholderQR<Eigen::MatrixXd> {
  using HouseholderQR::HouseholderQR;
};

HouseholderQr::HouseholderQr(const Eigen::MatrixXd& a)
    : factors_(std::make_unique<const Factors>(a)) {}
HouseholderQr::HouseholderQr(HouseholderQr&&) noexcept = default;
HouseholderQr::~HouseholderQr() = default;

Eigen::Index HouseholderQr::rows() const noexcept { return factors_->rows(); }
Eigen::Index HouseholderQr::columns() const noexcept { return factors_->cols(); }

Eigen::MatrixXd HouseholderQr::triangle() const {
  return factors_->matrixQR().topRows(columns()).triangularView<Eigen::Upper>();
}

Eigen::MatrixXd HouseholderQr::rotate(const Eigen::MatrixXd& x) const {
  return factors_->householderQ().adjoint() * x;
}

Eigen::MatrixXd HouseholderQr::rotate_back(const Eigen::MatrixXd& x) const {
  return factors_->householderQ() * x;
}

Eigen::VectorXd HouseholderQr::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }

Eigen::VectorXd pivoted_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

Eigen::MatrixXd solve_upper(const Eigen::MatrixXd& r, const Eigen::MatrixXd& b) {
  return r.triangularView<Eigen::Upper>().solve(b);
}

Eigen::MatrixXd divide_upper(const Eigen::MatrixXd& b, const Eigen::MatrixXd& r) {
  return r.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(b);
}

}  // namespace tactile_net
