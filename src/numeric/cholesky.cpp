#include "numeric/cholesky.hpp"

#include <Eigen/Cholesky>

namespace tactile_net {

struct Cholesky::Factors : Eigen::LLT<Eigen::MatrixXd> {
  using LLT::LLT;
};

Cholesky::Cholesky(const Eigen::MatrixXd& symmetric)
    : factors_(std::make_unique<const Factors>(symmetric)) {}
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;
Cholesky::~Cholesky() = default;

bool Cholesky::is_positive_definite() const noexcept { return factors_->info() == Eigen::Success; }

double Cholesky::reciprocal_condition() const { return factors_->rcond(); }

double Cholesky::log_determinant() const {
  return 2.0 * factors_->matrixLLT().diagonal().array().log().sum();
}

void Cholesky::solve_in_place(Eigen::Ref<Eigen::MatrixXd> x) const { factors_->solveInPlace(x); }

Eigen::MatrixXd Cholesky::solve_lower(const Eigen::MatrixXd& x) const {
  return factors_->matrixL().solve(x);
}

}  // namespace tactile_net
