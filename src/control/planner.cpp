#include "tactile_net/control/planner.hpp"

#include <cmath>
#include <stdexcept>

#include "control/planner_parts.hpp"
#include "control/product_planner.hpp"
#include "inverse/weighting.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

/// Whether mirroring the array mirrors a channel (+1) or negates it too (-1), as its kernel for
/// normal traction shows; a tangential traction turns round.
std::vector<std::int8_t> channel_signs(const LinearProblem& problem) {
  const auto kernel = as_eigen(problem.kernel);
  const auto taxels = static_cast<Eigen::Index>(channel_length(problem));
  const auto values = static_cast<Eigen::Index>(problem.grid.count());
  std::vector<std::int8_t> signs;
  for (Eigen::Index row = 0; row < kernel.rows(); row += taxels) {
    const Eigen::MatrixXd block = kernel.block(row, 0, taxels, values);
    signs.push_back(block.cwiseProduct(block.reverse()).sum() >= 0.0 ? 1 : -1);
  }
  return signs;
}

/// J W K J = W K but for rounding: no dead taxels, or those of mirror images.
bool is_symmetric(const Eigen::MatrixXd& kernel, const GridBlocks& rows,
                  const GridBlocks& columns) {
  const auto m = static_cast<Eigen::Index>(rows.columns);
  const auto n = static_cast<Eigen::Index>(columns.columns);
  double squares = 0.0;
  for (std::size_t i = 0; i < rows.signs_z.size(); ++i)
    for (std::size_t j = 0; j < columns.signs_z.size(); ++j) {
      const auto block =
          kernel.block(static_cast<Eigen::Index>(i) * m, static_cast<Eigen::Index>(j) * n, m, n);
      const double sign = rows.signs_z[i] * columns.signs_z[j];
      squares += (block - sign * block.reverse()).squaredNorm();
    }
  return std::sqrt(squares) <= 1e-12 * kernel.norm();
}

/// The weight of each channel (`channel_length`), on all of its readings: dead taxels have rows of
/// zeros anyway.
Eigen::VectorXd line_weights(const LinearProblem& problem) {
  const auto n = static_cast<Eigen::Index>(channel_length(problem));
  Eigen::VectorXd weights = as_eigen(std::span(problem.weights));
  for (Eigen::Index row = 0; row < weights.size(); row += n) {
    const double largest = weights.segment(row, n).maxCoeff();
    weights.segment(row, n).setConstant(largest > 0.0 ? largest : 1.0);
  }
  return weights;
}

/// A convolution takes a line of values to one of as many.
bool can_be_convolution(const LinearProblem& problem) {
  return problem.grid.count() == problem.taxels && problem.grid.stride_rows == 1;
}

/// M W^-1: from weighted readings to tractions.
ProductTask reconstruction_task(const LinearProblem& problem, const Reconstruction& inverse,
                                const PlannerOptions& options) {
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);  // W K
  ProductTask task;
  task.column_factors = line_weights(problem);
  task.matrix =
      as_eigen(inverse.transposed()).transpose() * task.column_factors.cwiseInverse().asDiagonal();
  task.row_factors = Eigen::VectorXd::Ones(task.matrix.rows());
  task.row_grid = line_blocks(problem.grid.count(), {1});
  if (problem.components == 2) task.row_grid = line_blocks(problem.grid.count(), {1, -1});
  task.column_grid = line_blocks(channel_length(problem), channel_signs(problem));
  task.symmetric = is_symmetric(kernel, task.column_grid, task.row_grid);
  task.explained = kernel;
  task.accuracy = options.accuracy;
  task.structure = options.structure;
  task.precision = options.precision;
  task.allow_fft =
      (options.allow_fft || options.structure == Structure::fft) && can_be_convolution(problem);
  task.all_candidates = options.all_candidates;
  return task;
}

/// W K M W^-1, eigenvalues in [0, 1): the readings that the tractions explain, and the constants
/// where they are free.
ProductTask prediction_task(const ProductTask& reconstruction, const Weighting& weighting) {
  ProductTask task;
  task.matrix = reconstruction.explained * reconstruction.matrix +
                weighting.constants() * weighting.constants().transpose();
  task.row_factors = reconstruction.column_factors.cwiseInverse();
  task.column_factors = reconstruction.column_factors;
  task.row_grid = reconstruction.column_grid;
  task.column_grid = reconstruction.column_grid;
  task.symmetric = reconstruction.symmetric;
  task.accuracy = reconstruction.accuracy;
  task.allow_fft = reconstruction.allow_fft;
  task.precision = Precision::float64;  // a residual is a small difference
  return task;
}

/// Of the normal force h sum f_v, per unit of noise: the posterior's.
double force_deviation(const LinearProblem& problem, double alpha) {
  std::vector<double> sum(problem.kernel.columns);
  std::fill_n(sum.begin(), problem.grid.count(), problem.grid.spacing_y);
  return TractionCovariance(problem, alpha, alpha).deviation(sum);
}

std::string why_no_fft(const LinearProblem& problem, const ProductTask& task,
                       const PlannedProduct& planned) {
  if (!can_be_convolution(problem))
    return "the surface has values between the taxels or beyond them";
  if (!task.allow_fft)
    return "it needs an FFT in the controller (tactile_net::spectral): allow_fft";
  if (!planned.symmetric)
    return "the array is not mirror symmetric (dead or uneven taxels, gains?)";
  if (task.structure.value_or(Structure::fft) != Structure::fft ||
      task.precision == Precision::float32)
    return "another structure or precision is asked for";
  return {};
}

}  // namespace

PlannedEstimator plan_estimator(const LinearProblem& problem, double alpha,
                                const PlannerOptions& options) {
  check(options, problem.weights.size());
  if (options.structure == Structure::fft && !can_be_convolution(problem))
    throw std::invalid_argument(
        "structure fft needs the tractions at the taxels: surface = \"taxels\"");

  ProductTask task = reconstruction_task(problem, tikhonov(problem, alpha), options);
  if (options.calibration) take_raw(task, *options.calibration, channel_length(problem));
  PlannedProduct reconstruction = plan_product(task);
  PlannedEstimator planned{.candidates = std::move(reconstruction.candidates),
                           .asymmetry = reconstruction.asymmetry,
                           .without_fft = why_no_fft(problem, task, reconstruction)};
  EstimatorPlan& plan = planned.plan;
  plan.count = problem.taxels;
  plan.channels = problem.sites.back().channel + 1;
  if (plan.readings() != problem.sites.size() || channel_length(problem) != problem.taxels)
    for (const Site& site : problem.sites)
      plan.taxels.push_back(static_cast<std::uint32_t>(site.taxel));
  plan.unknowns = problem.components;
  plan.values = problem.grid.count();
  plan.spacing = problem.grid.spacing_y;
  plan.centre = problem.grid.centre_y;
  plan.alpha = alpha;
  plan.reconstruction = std::move(reconstruction.plan);
  plan.weights = problem.weights;
  take_options(planned, options, problem.unknown_offsets);
  if (options.noise_rms > 0.0) {
    plan.force_deviation = options.noise_rms * force_deviation(problem, alpha);
    if (options.diagnostics)
      plan.residual_limit =
          options.noise_rms *
          noise_limit(plan.weights, static_cast<std::size_t>(Weighting(problem).rows()));
  }

  if (options.diagnostics) {
    const ProductTask prediction = prediction_task(task, Weighting(problem));
    plan.prediction = plan_product(prediction).plan;
    plan.leverages = leverages_of(prediction.matrix);
  }
  check(plan);
  return planned;
}

std::string PlannedEstimator::why() const {
  std::string result = "accuracy " + brief(plan.accuracy, 2) + " asked for, " +
                       brief(plan.error_bound, 2) + " proven; mirror symmetric to " +
                       brief(asymmetry, 1) + '\n';
  for (const Candidate& candidate : candidates) {
    std::string line(candidate.chosen ? "* " : "  ");
    line += name(candidate.structure);
    if (candidate.exchanged) line += " and exchange";
    line += ' ';
    line += name(candidate.precision);
    if (!candidate.ranks.empty()) {
      line += ", rank";
      for (std::size_t i = 0; i < candidate.ranks.size(); ++i)
        line += (i == 0 ? " " : " + ") + std::to_string(candidate.ranks[i]);
    }
    if (candidate.transform_size > 0)
      line += ", transforms of " + std::to_string(candidate.transform_size);
    line += ": " + std::to_string(candidate.bytes) + " bytes a frame";
    line += ", error <= " + brief(candidate.error_bound, 1);
    if (!candidate.accurate) line += " (not accurate enough)";
    result += line + '\n';
  }
  if (!without_fft.empty()) result += "  no fft: " + without_fft + '\n';
  return result;
}

}  // namespace tactile_net
