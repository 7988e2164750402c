#include "numeric/sparse_elimination.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>

namespace tactile_net {

struct SparseLu::Factors : Eigen::SparseLU<Eigen::SparseMatrix<double>> {
  using SparseLU::SparseLU;
};

SparseLu::SparseLu(const Eigen::SparseMatrix<double>& a) : factors_(std::make_unique<Factors>(a)) {
  for (Eigen::Index column = 0; column < a.cols(); ++column)
    norm_ = std::max(norm_, a.col(column).cwiseAbs().sum());
}
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu::~SparseLu() = default;

bool SparseLu::regular() const noexcept { return factors_->info() == Eigen::Success; }
Eigen::VectorXd SparseLu::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd SparseLu::solve(const Eigen::MatrixXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd SparseLu::solve_transposed(const Eigen::MatrixXd& b) const {
  return factors_->transpose().solve(b);
}

double SparseLu::reciprocal_condition() const {
  // Hager 1984: the largest 1-norm of A^-1 x, |x|_1 = 1, is at a unit vector; climbs to one.
  const Eigen::Index size = factors_->rows();
  Eigen::VectorXd x = Eigen::VectorXd::Constant(size, 1.0 / static_cast<double>(size));
  double of_inverse = 0.0;
  for (int step = 0; step < 5; ++step) {
    const Eigen::VectorXd y = solve(x);
    if (!y.allFinite()) return 0.0;
    if (y.lpNorm<1>() <= of_inverse) break;
    of_inverse = y.lpNorm<1>();
    const Eigen::VectorXd slope =
        solve_transposed(y.unaryExpr([](double one) { return one < 0.0 ? -1.0 : 1.0; }));
    Eigen::Index steepest = 0;
    if (slope.cwiseAbs().maxCoeff(&steepest) <= slope.dot(x)) break;
    x = Eigen::VectorXd::Unit(size, steepest);
  }
  return 1.0 / (norm_ * of_inverse);
}

struct SparseLdl::Factors : Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> {
  using SimplicialLDLT::SimplicialLDLT;
};

SparseLdl::SparseLdl(const Eigen::SparseMatrix<double>& symmetric)
    : factors_(std::make_unique<const Factors>(symmetric)) {}
SparseLdl::SparseLdl(SparseLdl&&) noexcept = default;
SparseLdl::~SparseLdl() = default;

bool SparseLdl::regular() const noexcept { return factors_->info() == Eigen::Success; }
Eigen::VectorXd SparseLdl::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }

}  // namespace tactile_net
