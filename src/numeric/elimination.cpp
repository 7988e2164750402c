#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "numeric/decompositions.hpp"

namespace tactile_net {

struct Lu::Factors : Eigen::PartialPivLU<Eigen::MatrixXd> {
  using PartialPivLU::PartialPivLU;
};

Lu::Lu(const Eigen::MatrixXd& a) : factors_(std::make_unique<const Factors>(a)) {}
Lu::Lu(Lu&&) noexcept = default;
Lu::~Lu() = default;

Eigen::VectorXd Lu::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd Lu::solve(const Eigen::MatrixXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd Lu::inverse() const { return factors_->inverse(); }

bool Lu::negative_determinant() const {
  const auto negative = (factors_->matrixLU().diagonal().array() < 0.0).count();
  return (negative % 2 == 1) != (factors_->permutationP().determinant() < 0);
}

double Lu::reciprocal_condition() const { return factors_->rcond(); }

struct CompleteLu::Factors : Eigen::FullPivLU<Eigen::MatrixXd> {
  using FullPivLU::FullPivLU;
};

CompleteLu::CompleteLu(const Eigen::MatrixXd& a) : factors_(std::make_unique<const Factors>(a)) {}
CompleteLu::CompleteLu(CompleteLu&&) noexcept = default;
CompleteLu::~CompleteLu() = default;

Eigen::VectorXd CompleteLu::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }

bool is_positive_definite(const Eigen::MatrixXd& symmetric) {
  return Eigen::LLT<Eigen::MatrixXd>(symmetric).info() == Eigen::Success;
}

Eigen::VectorXd solve_definite(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return Eigen::LDLT<Eigen::MatrixXd>(a).solve(b);
}

}  // namespace tactile_net
