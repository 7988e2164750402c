#include "tactile_net/inverse/linear_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "inverse/assembly.hpp"
#include "inverse/checks.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/stabiliser.hpp"

namespace tactile_net {
namespace {

/// P W K for W K, where offsets are unknown, and what P takes: `constants` of the problem.
///
/// @param taken  C of what has been taken before
void take_offsets_out(LinearProblem& problem, const Eigen::MatrixXd& taken = {}) {
  if (!problem.unknown_offsets) return;
  const Weighting weighting(problem);
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);
  Eigen::MatrixXd constants = weighting.constants().transpose() * kernel;
  problem.kernel_error =
      std::hypot(problem.kernel_error, std::numeric_limits<double>::epsilon() * constants.norm());
  if (taken.size() > 0)
    constants += weighting.constants().transpose() * taken * as_eigen(problem.constants);
  problem.constants = from_eigen(constants);
  problem.kernel = from_eigen(weighting.projected(kernel));
}

/// A kernel of which nothing but rounding is left is 0: readings that depend on no traction would
/// be explained by tractions 1e16 times too large.
void drop_kernel_of_rounding(LinearProblem& problem) {
  std::vector<double>& entries = problem.kernel.values;
  const double rounding = 4.0 * problem.kernel_error;  // and that of a projection
  if (std::all_of(entries.begin(), entries.end(),
                  [&](double entry) { return std::abs(entry) <= rounding; }))
    std::fill(entries.begin(), entries.end(), 0.0);
}

}  // namespace

Eigen::MatrixXd channel_constants(std::span<const double> weights, std::span<const Site> sites) {
  const auto channels = static_cast<Eigen::Index>(sites.back().channel) + 1;
  Eigen::MatrixXd constants = Eigen::MatrixXd::Zero(std::ssize(weights), channels);
  for (std::size_t i = 0; i < sites.size(); ++i)
    constants(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(sites[i].channel)) =
        weights[i];
  for (Eigen::Index c = 0; c < channels; ++c) constants.col(c).normalize();
  return constants;
}

Weighting::Weighting(std::span<const double> weights, std::span<const Site> sites,
                     bool unknown_offsets)
    : weights_(as_eigen(weights)), constants_(weights_.size(), 0) {
  if (unknown_offsets) constants_ = channel_constants(weights, sites);
}

void finish_kernel(LinearProblem& problem) {
  take_offsets_out(problem);
  drop_kernel_of_rounding(problem);
}

void leave_out(LinearProblem& problem, std::span<const std::size_t> taxels) {
  const Eigen::MatrixXd taken = Weighting(problem).constants();
  for (std::size_t row = 0; row < problem.sites.size(); ++row) {
    if (std::find(taxels.begin(), taxels.end(), problem.sites[row].taxel) == taxels.end()) continue;
    problem.weights[row] = 0.0;
    for (std::size_t column = 0; column < problem.kernel.columns; ++column)
      problem.kernel(row, column) *= 0.0;  // as make_problem does, sign and all
  }
  // What was taken from more rows is constant in those that are left, too.
  take_offsets_out(problem, taken);
  drop_kernel_of_rounding(problem);
}

std::vector<double> weighted(const LinearProblem& problem, std::span<const double> readings) {
  check_size(readings, problem.weights.size());
  const Eigen::VectorXd rows = Weighting(problem)(readings);
  return {rows.begin(), rows.end()};
}

std::vector<double> offsets(const LinearProblem& problem, std::span<const double> readings,
                            std::span<const double> tractions) {
  check_size(readings, problem.weights.size());
  check_tractions(tractions, problem.kernel.columns);
  if (!problem.unknown_offsets) return {};
  const Weighting weighting(problem);
  const Eigen::VectorXd left =
      weighting.constants().transpose() * weighting.weights().cwiseProduct(as_eigen(readings)) -
      as_eigen(problem.constants) * as_eigen(tractions);
  const Eigen::VectorXd size = weighting.constants().transpose() * weighting.weights();
  std::vector<double> result;
  for (Eigen::Index c = 0; c < left.size(); ++c)
    result.push_back(size(c) > 0.0 ? left(c) / size(c) : 0.0);
  return result;
}

std::size_t independent_readings(const LinearProblem& problem) {
  return static_cast<std::size_t>(Weighting(problem).rows());
}

std::size_t channel_length(const LinearProblem& problem) {
  std::vector<std::size_t> lengths(problem.sites.back().channel + 1);
  for (const Site& site : problem.sites) ++lengths[site.channel];
  const bool alike = std::all_of(lengths.begin(), lengths.end(),
                                 [&](std::size_t one) { return one == lengths.front(); });
  return alike ? lengths.front() : problem.sites.size();
}

Matrix normal_matrix(const LinearProblem& problem, double alpha) {
  const auto kernel = as_eigen(problem.kernel);
  const Matrix stabiliser = stabiliser_matrix(problem, alpha);
  RowMajor p = as_eigen(stabiliser);
  p.selfadjointView<Eigen::Upper>().rankUpdate(kernel.transpose());
  p.triangularView<Eigen::StrictlyLower>() = p.transpose();
  return from_eigen(p);
}

std::vector<double> normal_right_side(const LinearProblem& problem,
                                      std::span<const double> readings) {
  const std::vector<double> rows = weighted(problem, readings);
  const Eigen::VectorXd sums = as_eigen(problem.kernel).transpose() * as_eigen(std::span(rows));
  return {sums.begin(), sums.end()};
}

}  // namespace tactile_net
