#include "numeric/sparse_elimination.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

namespace tactile_net {

struct SparseLu::Factors : Eigen::SparseLU<Eigen::SparseMatrix<double>> {
  using SparseLU::SparseLU;
};

SparseLu::SparseLu(const Eigen::SparseMatrix<double>& a) : factors_(std::make_unique<Factors>(a)) {}
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu::~SparseLu() = default;

bool SparseLu::regular() const noexcept { return factors_->info() == Eigen::Success; }
Eigen::VectorXd SparseLu::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd SparseLu::solve_transposed(const Eigen::MatrixXd& b) const {
  return factors_->transpose().solve(b);
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
