#include "tactile_net/control/planner.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "control/cone_planner.hpp"
#include "control/filled_readings.hpp"
#include "control/plan_grids.hpp"
#include "control/planner_parts.hpp"
#include "control/product_planner.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

/// Structure fft is for lines alone, whose values a convolution takes to as many: a skin has two
/// reflections, and up to 32 x 32 taxels its classes are cheaper than a transform in two
/// dimensions.
bool can_be_convolution(const LinearProblem& problem) {
  return problem.is_line && problem.grid.count() == problem.taxels && problem.grid.stride_rows == 1;
}

void check_convolution(const LinearProblem& problem, const PlannerOptions& options) {
  if (options.structure != Structure::fft || can_be_convolution(problem)) return;
  throw std::invalid_argument(
      problem.is_line ? "structure fft needs the tractions at the taxels: surface = \"taxels\""
                      : "structure fft is of line arrays: a skin has reflections");
}

/// M W^-1: from weighted readings to tractions.
Eigen::MatrixXd of_weighted(const Matrix& inverse, const Eigen::VectorXd& weights) {
  return as_eigen(inverse) * weights.cwiseInverse().asDiagonal();
}

ProductTask reconstruction_task(const LinearProblem& problem, const Matrix& inverse,
                                const PlannerOptions& options) {
  ProductTask task;
  task.column_factors = channel_weights(problem);
  task.matrix = of_weighted(inverse, task.column_factors);
  task.row_factors = Eigen::VectorXd::Ones(task.matrix.rows());
  task.row_grid = traction_grid(problem);
  task.column_grid = reading_grid(problem);
  task.symmetric = task.column_grid.size() > 0;
  if (!task.symmetric) task.row_grid = {};
  if (task.row_grid.partners.empty()) task.column_grid.partners.clear();
  if (task.column_grid.partners.empty()) task.row_grid.partners.clear();
  task.explained = as_eigen(problem.kernel);
  task.accuracy = options.accuracy;
  task.structure = options.structure;
  task.precision = options.precision;
  task.allow_fft =
      (options.allow_fft || options.structure == Structure::fft) && can_be_convolution(problem);
  task.all_candidates = options.all_candidates;
  return task;
}

/// Fewer are missing among the independent ones where offsets are unknown: these take some.
std::size_t dead_readings(const LinearProblem& problem) {
  return static_cast<std::size_t>(std::count(problem.weights.begin(), problem.weights.end(), 0.0));
}

/// Whether dead taxels keep M from being symmetric: those that are each other's mirror images do
/// not.
bool is_spoilt(const ProductTask& task, const LinearProblem& problem) {
  return task.symmetric && !mirrors_itself(task.column_grid, problem.weights);
}

/// Turns a task into one of the whole, on readings that are filled in.
/// @param weights  of each reading, as if its taxel lived
void fill_in(ProductTask& task, const LinearProblem& problem, const LinearProblem& whole,
             double alpha, const Eigen::VectorXd& weights) {
  task.fill = filled_readings(problem, whole, task.matrix, weights);
  task.filled = dead_readings(problem);
  task.target =
      std::exchange(task.matrix, of_weighted(TikhonovFamily(whole).matrix(alpha), weights));
}

/// W K M W^-1, eigenvalues in [0, 1): the readings that the tractions explain, and the constants
/// where they are free; of what is filled in too.
///
/// @param problem  the whole where readings are filled in
/// @param filled   readings that are filled in for it alone
ProductTask prediction_task(const ProductTask& reconstruction, const LinearProblem& problem,
                            std::size_t filled) {
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);
  const Weighting weighting(problem);
  const Eigen::MatrixXd& constants = weighting.constants();
  ProductTask task;
  task.matrix = kernel * reconstruction.matrix;
  if (problem.unknown_offsets) task.matrix += constants * constants.transpose();
  if (reconstruction.fill.size() > 0) {
    task.fill = reconstruction.fill;
    task.filled = filled;
    task.target = kernel * reconstruction.target;
    if (problem.unknown_offsets) task.target += constants * (constants.transpose() * task.fill);
  }
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

/// Limits by which frames are judged, where the noise is known.
void take_noise(EstimatorPlan& plan, const LinearProblem& problem, const TikhonovFamily& family,
                const PlannerOptions& options) {
  const TractionCovariance posterior(family, plan.alpha, plan.alpha);
  std::vector<double> sum(plan.tractions());
  std::fill_n(sum.begin(), plan.values, problem.grid.area());
  plan.force_deviation = options.noise_rms * posterior.deviation(sum);
  if (options.diagnostics)
    plan.residual_limit =
        options.noise_rms * noise_limit(problem.weights, independent_readings(problem));
  if (plan.cells) add_deviations(*plan.cells, problem, posterior, options.noise_rms);
}

/// Sizes and places of readings and tractions.
EstimatorPlan plan_without_products(const LinearProblem& problem) {
  EstimatorPlan plan;
  plan.count = problem.taxels;
  plan.channels = problem.sites.back().channel + 1;
  plan.taxels = taxels_of_readings(problem);
  plan.unknowns = problem.components;
  plan.values = problem.grid.count();
  plan.weights = problem.weights;
  if (problem.is_line) {
    plan.spacing = problem.grid.spacing_y;
    plan.centre = problem.grid.centre_y;
    return plan;
  }
  plan.cells = plan_cells(problem);
  plan.spacing = std::sqrt(plan.cells->area());
  plan.unjudged = edge_taxels(problem);
  return plan;
}

std::string why_no_fft(const LinearProblem& problem, const ProductTask& task,
                       const PlannedProduct& planned) {
  if (!problem.is_line) return {};
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

void check_plan_input(const LinearProblem& problem, const PlannerOptions& options,
                      const LinearProblem* whole) {
  check(options, problem.weights.size());
  check_convolution(problem, options);
  if (whole != nullptr &&
      (whole->kernel.rows != problem.kernel.rows ||
       whole->kernel.columns != problem.kernel.columns ||
       whole->unknown_offsets != problem.unknown_offsets || dead_readings(*whole) > 0))
    throw std::invalid_argument("the whole is of another problem, or has dead taxels");
}

PlannedEstimator planned_estimator(const LinearProblem& problem, const TikhonovFamily& family,
                                   double alpha, const PlannerOptions& options,
                                   const LinearProblem* whole) {
  ProductTask task = reconstruction_task(problem, family.matrix(alpha), options);
  require_full_rank(family.condition(alpha), problem.kernel.rows);
  const Eigen::VectorXd weights = task.column_factors;
  const Eigen::MatrixXd inverse = options.cone ? task.matrix : Eigen::MatrixXd();
  if (options.calibration) take_raw(task, *options.calibration, problem.sites);
  const bool fills = whole != nullptr && is_spoilt(task, problem);
  if (fills) fill_in(task, problem, *whole, alpha, weights);

  PlannedProduct reconstruction = plan_product(task);
  std::optional<PlannedCone> cone;
  if (options.cone)
    cone = plan_cone({.problem = problem,
                      .alpha = alpha,
                      .inverse = inverse,
                      .grid = task.row_grid,
                      .noise_rms = options.noise_rms},
                     *options.cone);
  PlannedEstimator planned{.plan = plan_without_products(problem),
                           .candidates = std::move(reconstruction.candidates),
                           .asymmetry = reconstruction.asymmetry,
                           .without_fft = why_no_fft(problem, task, reconstruction)};
  EstimatorPlan& plan = planned.plan;
  plan.space = plan_space(problem, options.moment_about);
  plan.alpha = alpha;
  plan.reconstruction = std::move(reconstruction.plan);
  bool folds = has_reflections(plan.reconstruction.structure);
  take_options(planned, options, problem.unknown_offsets);
  if (options.noise_rms > 0.0) take_noise(plan, problem, family, options);
  if (options.diagnostics) {
    const ProductTask prediction =
        prediction_task(task, fills ? *whole : problem, folds ? 0 : task.filled);
    plan.leverages = leverages_of(fills ? prediction.target : prediction.matrix);
    plan.prediction = plan_product(prediction).plan;
    folds = folds || has_reflections(plan.prediction->structure);
  }
  if (cone) {
    plan.cone = std::move(cone->plan);
    planned.unfinished = std::move(cone->unfinished);
    if (problem.is_line && options.noise_rms > 0.0) {
      plan.line_cells = plan_cells(problem);
      add_deviations(*plan.line_cells, problem, TractionCovariance(family, alpha, alpha),
                     options.noise_rms);
    }
  }
  if (fills && folds) plan.fill = fill_factor(problem, task.fill, task.column_factors);
  check(plan);
  return planned;
}

}  // namespace

double planning_bytes(std::size_t readings, std::size_t tractions) noexcept {
  const auto m = static_cast<double>(readings);
  const auto n = static_cast<double>(tractions);
  // K and its coordinates, the family's factors, M three times, its classes twice over; and of the
  // prediction alike: 477 MB for 24 x 24 taxels that read three stresses, of which this says 492.
  return 8.0 * (10.0 * m * n + 7.0 * m * m);
}

PlannedEstimator plan_estimator(const LinearProblem& problem, double alpha,
                                const PlannerOptions& options, const LinearProblem* whole) {
  check_plan_input(problem, options, whole);
  return planned_estimator(problem, TikhonovFamily(problem), alpha, options, whole);
}

PlannedEstimator plan_estimator(const LinearProblem& problem, const TikhonovFamily& family,
                                double alpha, const PlannerOptions& options,
                                const LinearProblem* whole) {
  check_plan_input(problem, options, whole);
  if (family.factors() == nullptr ||
      family.analyse(std::vector<double>(problem.weights.size())).rows !=
          independent_readings(problem))
    throw std::invalid_argument("the family is of another problem");
  return planned_estimator(problem, family, alpha, options, whole);
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
