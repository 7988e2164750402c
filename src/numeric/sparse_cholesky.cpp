#include "numeric/sparse_cholesky.hpp"

#include <Eigen/SparseCholesky>

namespace tactile_net {

struct SparseCholesky::Factors {
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> llt;  // P A P' = L L', so that R = L' P
};

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& symmetric) {
  auto made = std::make_unique<Factors>();
  made->llt.compute(symmetric);
  factors_ = std::move(made);
}
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky::~SparseCholesky() = default;

bool SparseCholesky::definite() const noexcept { return factors_->llt.info() == Eigen::Success; }

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& x) const {
  return factors_->llt.permutationPinv() * factors_->llt.matrixU().solve(x);
}

Eigen::MatrixXd SparseCholesky::solve_transposed(const Eigen::MatrixXd& x) const {
  const Eigen::MatrixXd ordered = factors_->llt.permutationP() * x;
  return factors_->llt.matrixL().solve(ordered);
}

}  // namespace tactile_net
