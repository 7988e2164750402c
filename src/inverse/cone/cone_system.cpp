#include "inverse/cone/cone_system.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/power_iteration.hpp"

namespace tactile_net {

using Eigen::Index;

namespace {

const LinearProblem& checked(const LinearProblem& problem, const Constraints& limits) {
  check_cones(problem, limits);
  return problem;
}

/// The largest eigenvalue of P, by power iteration from what K shows best.
double largest_eigenvalue(const ConeProblem& problem, const Eigen::VectorXd& smoothing) {
  // What all readings add up to; that says nothing where each channel's constant is unknown.
  Eigen::VectorXd seen = Eigen::VectorXd::Ones(problem.kernel.rows());
  if (problem.rows.unknown_offsets)
    seen = problem.kernel * Eigen::VectorXd::Ones(problem.kernel.cols());
  Eigen::VectorXd start = problem.kernel.transpose() * seen;
  const double most = start.cwiseAbs().maxCoeff();
  for (Index i = 0; i < start.size(); ++i)
    start(i) += 1e-3 * most * std::cos(static_cast<double>(i));
  return power_iteration(problem.waves.sums(start), 100, 1e-4,
                         [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
                           return problem.product(x) + smoothing.cwiseProduct(x);
                         });
}

}  // namespace

ConeScales::ConeScales(const LinearProblem& problem)
    : kernel(as_eigen(problem.kernel).cwiseAbs().maxCoeff()), drag(problem.tangential_weight) {
  if (!(kernel > 0.0)) kernel = 1.0;
}

RowMajor ConeScales::kernel_of(const LinearProblem& problem) const {
  const auto cells = static_cast<Index>(problem.grid.count());
  RowMajor scaled = as_eigen(problem.kernel);
  scaled.leftCols(cells) /= kernel;
  scaled.rightCols(scaled.cols() - cells) /= kernel * drag;
  return scaled;
}

Constraints ConeScales::applied(Constraints constraints) const {
  if (constraints.friction_limit) *constraints.friction_limit *= drag;
  return constraints;
}

ConeProblem::ConeProblem(const LinearProblem& problem, const Constraints& limits)
    : scales(checked(problem, limits)),
      rows{problem.weights, problem.sites, problem.unknown_offsets},
      weighting(problem),
      cells(static_cast<Index>(problem.grid.count())),
      components(problem.components),
      area(problem.measure),
      constraints(scales.applied(limits)),
      kernel(scales.kernel_of(problem)),
      waves(problem, Eigen::VectorXd::Ones(kernel.cols())),
      spectrum(stabiliser_spectrum(problem, 1.0)) {
  for (MirrorClass& part : mirror_classes(problem)) {
    const Eigen::MatrixXd transposed = waves.sums_of(part.waves, folded_kernel(kernel, part));
    if (transposed.size() == 0) continue;
    Block block{.waves = std::move(part.waves)};
    if (transposed.cols() >= transposed.rows())
      block.square = transposed * transposed.transpose();
    else
      block.kernel = transposed.transpose();
    blocks.push_back(std::move(block));
  }
}

Eigen::VectorXd ConeProblem::product(const Eigen::VectorXd& c) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(c.size());
  for (const Block& block : blocks) {
    const Eigen::VectorXd own = c(block.waves);
    if (block.kernel.rows() == 0)
      result(block.waves) = block.square * own;
    else
      result(block.waves) = block.kernel.transpose() * (block.kernel * own);
  }
  return result;
}

ConeSystem::ConeSystem(std::shared_ptr<const ConeProblem> problem, double alpha, double share)
    : problem_(std::move(problem)),
      smoothing_(problem_->scales.applied(alpha) * problem_->spectrum),
      largest_(largest_eigenvalue(*problem_, smoothing_)),
      rho_(share * std::sqrt(largest_) *
           std::sqrt(problem_->scales.applied(alpha) * problem_->area)) {
  for (const ConeProblem::Block& block : problem_->blocks) inverses_.push_back(inverse(block));
}

double ConeSystem::above_all() const {
  double largest = 0.0;
  for (const ConeProblem::Block& block : problem_->blocks) {
    const Eigen::VectorXd values = symmetric_eigenvalues(
        block.kernel.rows() == 0 ? block.square
                                 : Eigen::MatrixXd(block.kernel * block.kernel.transpose()));
    if (values.size() > 0) largest = std::max(largest, values(values.size() - 1));
  }
  return largest * (1.0 + 1e-9) + smoothing_.maxCoeff();
}

Eigen::MatrixXd ConeSystem::inverse(const ConeProblem::Block& block) const {
  const Eigen::VectorXd diagonal = smoothing_(block.waves).array() + rho_;
  Eigen::MatrixXd whole = block.square;
  if (block.kernel.rows() == 0) {
    whole.diagonal() += diagonal;
  } else {
    const Eigen::MatrixXd stretched =
        block.kernel * diagonal.cwiseSqrt().cwiseInverse().asDiagonal();
    whole = stretched * stretched.transpose();
    whole.diagonal().array() += 1.0;
  }
  const Cholesky root(whole);
  if (!root.is_positive_definite())
    throw std::domain_error("alpha is too small for constraints: smooth more");
  whole.setIdentity();
  root.solve_in_place(whole);
  return whole;
}

Eigen::VectorXd ConeSystem::solve(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd c = problem_->waves.sums(x);
  const Eigen::VectorXd diagonal = smoothing_.array() + rho_;
  Eigen::VectorXd y = c.cwiseQuotient(diagonal);
  for (std::size_t i = 0; i < inverses_.size(); ++i) {
    const ConeProblem::Block& block = problem_->blocks[i];
    if (block.kernel.rows() == 0) {
      y(block.waves) = inverses_[i] * Eigen::VectorXd(c(block.waves));
      continue;
    }
    // D^-1 - D^-1 K' (1 + K D^-1 K')^-1 K D^-1: of as many numbers as there are readings.
    Eigen::VectorXd own = y(block.waves);
    const Eigen::VectorXd seen = inverses_[i] * (block.kernel * own);
    own -= (block.kernel.transpose() * seen).cwiseQuotient(diagonal(block.waves));
    y(block.waves) = own;
  }
  return problem_->waves.tractions(y);
}

Eigen::VectorXd ConeSystem::product(const Eigen::VectorXd& x) const {
  const Eigen::VectorXd c = problem_->waves.sums(x);
  return problem_->waves.tractions(problem_->product(c) + smoothing_.cwiseProduct(c));
}

}  // namespace tactile_net
