#include "tactile_net/control/skin_planner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "control/planner_parts.hpp"
#include "control/product_planner.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/skin/covariance.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

int sign(bool is_negative) { return is_negative ? -1 : 1; }

/// Channels of a regular skin as grids; of no size for an irregular one.
GridBlocks reading_grid(const LinearProblem& problem) {
  const SurfaceGrid& grid = problem.grid;
  if (grid.stride_rows == 0 || grid.stride_columns == 0) return {};
  GridBlocks blocks;
  blocks.rows = (grid.rows - 1 - 2 * grid.margin_rows) / grid.stride_rows + 1;
  blocks.columns = (grid.columns - 1 - 2 * grid.margin_columns) / grid.stride_columns + 1;
  std::vector<Site> first;  // of each channel
  for (const Site& site : problem.sites)
    if (site.channel == first.size()) first.push_back(site);
  for (const Site& site : first) {
    blocks.signs_y.push_back(
        static_cast<std::int8_t>(sign(is_odd(site.quantity, Traction::normal, Axis::y))));
    blocks.signs_z.push_back(
        static_cast<std::int8_t>(sign(is_odd(site.quantity, Traction::normal, Axis::z))));
  }
  if (blocks.size() != problem.sites.size()) return {};
  if (blocks.rows != blocks.columns) return blocks;
  for (const Site& site : first) {
    const auto partner = std::find_if(first.begin(), first.end(), [&](const Site& other) {
      return other.depth == site.depth && other.quantity == exchanged(site.quantity);
    });
    if (partner == first.end()) {
      blocks.partners.clear();
      break;
    }
    blocks.partners.push_back(static_cast<std::uint32_t>(partner - first.begin()));
  }
  return blocks;
}

GridBlocks traction_grid(const LinearProblem& problem) {
  GridBlocks blocks{.rows = problem.grid.rows, .columns = problem.grid.columns};
  for (std::size_t u = 0; u < problem.components; ++u) {
    blocks.signs_y.push_back(u == 1 ? -1 : 1);
    blocks.signs_z.push_back(u == 2 ? -1 : 1);
  }
  if (blocks.rows != blocks.columns) return blocks;
  blocks.partners = {0};
  if (problem.components == 3) blocks.partners = {0, 2, 1};
  return blocks;
}

/// The weight of each channel, on all of its readings.
Eigen::VectorXd channel_weights(const LinearProblem& problem) {
  Eigen::VectorXd weights = as_eigen(std::span(problem.weights));
  std::vector<double> largest;
  for (const bool fill : {false, true})
    for (std::size_t i = 0; i < problem.sites.size(); ++i) {
      const std::size_t channel = problem.sites[i].channel;
      if (largest.size() <= channel) largest.resize(channel + 1);
      if (!fill)
        largest[channel] = std::max(largest[channel], problem.weights[i]);
      else
        weights(static_cast<Index>(i)) = largest[channel] > 0.0 ? largest[channel] : 1.0;
    }
  return weights;
}

/// M W^-1, from weighted readings to tractions.
Eigen::MatrixXd reconstruction_of(const SkinFamily& family, double alpha,
                                  const Eigen::VectorXd& weights) {
  const Reconstruction inverse = family.reconstruction(alpha);
  return as_eigen(inverse.transposed()).transpose() * weights.cwiseInverse().asDiagonal();
}

/// Of the whole skin, and how its readings follow from those of the live taxels.
struct Whole {
  Eigen::MatrixXd kernel;          // W K
  Eigen::MatrixXd reconstruction;  // M W^-1
  Eigen::MatrixXd fill;            // weighted readings of all, from those of the live ones
};

Whole whole_of(const LinearProblem& problem, const LinearProblem& whole, double alpha,
               const Eigen::MatrixXd& without, const Eigen::VectorXd& weights) {
  Whole result;
  result.kernel = as_eigen(whole.kernel);
  result.reconstruction = reconstruction_of(SkinFamily(whole), alpha, weights);
  // Where offsets are unknown: the constant that the live readings of a channel leave to it, of the
  // live readings, in the unit of a weighted one.
  const Weighting live(problem);
  const Eigen::MatrixXd sums = live.constants().transpose();
  const Eigen::MatrixXd left = sums - (sums * result.kernel) * without;
  const Eigen::VectorXd sizes = sums * live.weights();
  const auto n = static_cast<Index>(problem.weights.size());
  result.fill = Eigen::MatrixXd::Zero(n, n);
  // A row left out is a row that reads what the others predict of it.
  for (Index i = 0; i < n; ++i) {
    if (live.weights()(i) > 0.0) {
      result.fill(i, i) = 1.0;
      continue;
    }
    result.fill.row(i) = result.kernel.row(i) * without;
    if (!problem.unknown_offsets) continue;
    const auto channel = static_cast<Index>(problem.sites[static_cast<std::size_t>(i)].channel);
    if (sizes(channel) > 0.0) result.fill.row(i) += weights(i) / sizes(channel) * left.row(channel);
  }
  return result;
}

void take_fill(EstimatorPlan& plan, const Eigen::MatrixXd& fill, const Eigen::VectorXd& factors) {
  Factor& rows = plan.fill.emplace();
  rows.columns = plan.readings();
  for (Index i = 0; i < fill.rows(); ++i) {
    if (plan.weights[static_cast<std::size_t>(i)] > 0.0) continue;
    ++rows.rows;
    for (Index j = 0; j < fill.cols(); ++j)
      rows.values.push_back(fill(i, j) * (factors(j) / factors(i)));
  }
}

/// Taxels that have none of their twelve nearest beyond them in some direction.
std::vector<std::uint32_t> edge_taxels(const LinearProblem& problem) {
  struct Place {
    double y = 0.0, z = 0.0;
  };
  std::vector<Place> places(problem.taxels);
  for (const Site& site : problem.sites) places[site.taxel] = {site.y, site.z};
  std::vector<std::uint32_t> edge;
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::vector<std::pair<double, double>> others;  // distance, direction
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double y = places[k].y - places[i].y;
      const double z = places[k].z - places[i].z;
      if (y != 0.0 || z != 0.0) others.emplace_back(std::hypot(y, z), std::atan2(z, y));
    }
    const auto near = others.begin() + std::min<std::ptrdiff_t>(12, std::ssize(others));
    std::partial_sort(others.begin(), near, others.end());
    std::vector<double> directions;
    for (auto other = others.begin(); other != near; ++other) directions.push_back(other->second);
    std::sort(directions.begin(), directions.end());
    double gap = 2.0 * std::numbers::pi;
    if (!directions.empty()) {
      gap -= directions.back() - directions.front();
      for (std::size_t k = 1; k < directions.size(); ++k)
        gap = std::max(gap, directions[k] - directions[k - 1]);
    }
    if (gap > 0.95 * std::numbers::pi) edge.push_back(static_cast<std::uint32_t>(i));
  }
  return edge;
}

double least_depth(const LinearProblem& problem) {
  double depth = problem.sites.front().depth;
  for (const Site& site : problem.sites) depth = std::min(depth, site.depth);
  return depth;
}

PlanCells cells_of(const LinearProblem& problem) {
  const SurfaceGrid& grid = problem.grid;
  const double depth = least_depth(problem);
  const auto rim = [&](double spacing) {
    return static_cast<std::size_t>(std::lround(std::min(0.5 * depth / spacing, 1e6)));
  };
  return {.rows = grid.rows,
          .columns = grid.columns,
          .spacing_y = grid.spacing_y,
          .spacing_z = grid.spacing_z,
          .centre_y = grid.centre_y,
          .centre_z = grid.centre_z,
          .rim_rows = rim(grid.spacing_y),
          .rim_columns = rim(grid.spacing_z)};
}

/// What noise does to the tractions, for frames to be judged by.
void take_noise(EstimatorPlan& plan, const LinearProblem& problem, const SkinFamily& family,
                double alpha, const PlannerOptions& options) {
  const SkinCovariance covariance(family, alpha, alpha);
  PlanCells& cells = *plan.cells;
  cells.deviations = covariance.deviations();
  cells.deviations.resize(plan.values);
  for (double& deviation : cells.deviations) deviation *= options.noise_rms;
  const CellWindow window = window_of(problem.grid, least_depth(problem));
  cells.window_deviations = covariance.window_deviations(problem.grid, window);
  for (double& deviation : cells.window_deviations) deviation *= options.noise_rms;
  cells.window_rows = window.rows;
  cells.window_columns = window.columns;
  std::vector<double> sum(plan.tractions());
  std::fill_n(sum.begin(), plan.values, cells.area());
  plan.force_deviation = options.noise_rms * covariance.deviation(sum);
  if (options.diagnostics)
    plan.residual_limit =
        options.noise_rms * noise_limit(problem.weights, independent_readings(problem));
}

/// Fewer than are missing among the independent ones where offsets are unknown: these take some.
std::size_t dead_readings(const LinearProblem& problem) {
  return static_cast<std::size_t>(std::count(problem.weights.begin(), problem.weights.end(), 0.0));
}

void check_sizes(const LinearProblem& problem, const SkinFamily& family,
                 const LinearProblem* whole) {
  if (family.factors() == nullptr ||
      family.analyse(std::vector<double>(problem.weights.size())).rows !=
          independent_readings(problem))
    throw std::invalid_argument("the family is of another problem");
  if (whole != nullptr &&
      (whole->kernel.rows != problem.kernel.rows ||
       whole->kernel.columns != problem.kernel.columns ||
       whole->unknown_offsets != problem.unknown_offsets || dead_readings(*whole) > 0))
    throw std::invalid_argument("the whole is of another problem, or has dead taxels");
}

}  // namespace

double planning_bytes(std::size_t readings, std::size_t tractions) noexcept {
  const auto m = static_cast<double>(readings);
  const auto n = static_cast<double>(tractions);
  // K and its coordinates, the family's factors, M three times, its classes twice over; and of the
  // prediction alike: 477 MB for 24 x 24 taxels that read three stresses, of which this says 492.
  return 8.0 * (10.0 * m * n + 7.0 * m * m);
}

PlannedEstimator plan_estimator(const LinearProblem& problem, const SkinFamily& family,
                                double alpha, const PlannerOptions& options,
                                const LinearProblem* whole) {
  check(options, problem.weights.size());
  check_sizes(problem, family, whole);
  if (options.structure == Structure::fft)
    throw std::invalid_argument("structure fft is of line arrays: a skin has reflections");
  const std::size_t dead = dead_readings(problem);

  ProductTask task;
  task.column_factors = channel_weights(problem);
  const Eigen::VectorXd weights = task.column_factors;
  task.matrix = reconstruction_of(family, alpha, weights);
  task.row_factors = Eigen::VectorXd::Ones(task.matrix.rows());
  task.explained = as_eigen(problem.kernel);
  task.accuracy = options.accuracy;
  task.structure = options.structure;
  task.precision = options.precision;
  task.all_candidates = options.all_candidates;
  task.symmetric = true;
  if (options.calibration) take_raw(task, *options.calibration, problem.taxels);
  std::optional<Whole> all;
  if (dead > 0 && whole != nullptr && task.symmetric) {
    all = whole_of(problem, *whole, alpha, task.matrix, weights);
    task.target = std::exchange(task.matrix, all->reconstruction);
    task.fill = all->fill;
    task.filled = dead;
  }
  if (task.symmetric && (all || dead == 0)) {
    task.row_grid = traction_grid(problem);
    task.column_grid = reading_grid(problem);
  }
  if (task.column_grid.size() == 0) task.row_grid = {};

  PlannedProduct reconstruction = plan_product(task);
  PlannedEstimator planned{.candidates = std::move(reconstruction.candidates),
                           .asymmetry = reconstruction.asymmetry};
  EstimatorPlan& plan = planned.plan;
  plan.cells = cells_of(problem);
  plan.count = problem.taxels;
  plan.channels = problem.sites.back().channel + 1;
  plan.unknowns = problem.components;
  plan.values = problem.grid.count();
  plan.spacing = std::sqrt(plan.cells->area());
  plan.alpha = alpha;
  if (reading_grid(problem).size() == 0)
    for (const Site& site : problem.sites)
      plan.taxels.push_back(static_cast<std::uint32_t>(site.taxel));
  plan.unjudged = edge_taxels(problem);
  plan.reconstruction = std::move(reconstruction.plan);
  plan.weights = problem.weights;
  take_options(planned, options, problem.unknown_offsets);
  if (options.noise_rms > 0.0) take_noise(plan, problem, family, alpha, options);

  if (options.diagnostics) {
    // W K M W^-1: the readings that the tractions explain, and the constants where they are free;
    // of what is dead too.
    const Eigen::MatrixXd& kernel = all ? all->kernel : task.explained;
    ProductTask prediction = task;
    prediction.explained.resize(0, 0);
    prediction.matrix = kernel * task.matrix;
    if (all) prediction.target = kernel * task.target;
    if (problem.unknown_offsets) {
      const Eigen::MatrixXd constants = Weighting(all ? *whole : problem).constants();
      prediction.matrix += constants * constants.transpose();
      if (all) prediction.target += constants * (constants.transpose() * task.fill);
    }
    prediction.row_factors = task.column_factors.cwiseInverse();
    prediction.row_grid = task.column_grid;
    prediction.structure.reset();
    prediction.precision = Precision::float64;  // a residual is a small difference
    prediction.filled = has_reflections(plan.reconstruction.structure) ? 0 : task.filled;
    plan.leverages = leverages_of(all ? prediction.target : prediction.matrix);
    plan.prediction = plan_product(prediction).plan;
  }
  if (all && (has_reflections(plan.reconstruction.structure) ||
              (plan.prediction && has_reflections(plan.prediction->structure))))
    take_fill(plan, all->fill, task.column_factors);
  check(plan);
  return planned;
}

}  // namespace tactile_net
