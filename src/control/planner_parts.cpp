#include "control/planner_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "inverse/significance.hpp"
#include "numeric/eigen.hpp"
#include "skin/cell_wrench.hpp"
#include "tactile_net/sensing/surface_cells.hpp"
#include "tactile_net/skin/resultant.hpp"

namespace tactile_net {
namespace {

/// Whether all readings of each channel, which follow one another, have one gain.
bool is_constant_in_channels(const std::vector<double>& gain, std::span<const Site> sites) {
  for (std::size_t i = 1; i < gain.size(); ++i)
    if (sites[i].channel == sites[i - 1].channel && gain[i] != gain[i - 1]) return false;
  return true;
}

/// gain (raw - baseline) + offset = gain (raw - result); empty: all 0.
std::vector<double> raw_baseline(const Calibration& calibration) {
  std::vector<double> result = calibration.baseline;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] -= calibration.offset[i] / calibration.gain[i];
  const auto is_zero = [](double value) { return value == 0.0; };
  if (std::all_of(result.begin(), result.end(), is_zero)) result.clear();
  return result;
}

double least_depth(const LinearProblem& problem) {
  double depth = problem.sites.front().depth;
  for (const Site& site : problem.sites) depth = std::min(depth, site.depth);
  return depth;
}

}  // namespace

void check(const PlannerOptions& options, std::size_t readings) {
  if (!(options.accuracy > 0.0) || !std::isfinite(options.accuracy))
    throw std::invalid_argument("accuracy must be > 0 and finite");
  for (const double place : options.moment_about)
    if (!std::isfinite(place)) throw std::invalid_argument("moment_about must be finite");
  if (options.calibration) check(*options.calibration, readings);
}

void take_raw(ProductTask& task, const Calibration& calibration, std::span<const Site> sites) {
  task.column_factors.array() *= as_eigen(std::span(calibration.gain)).array();
  task.symmetric = task.symmetric && is_constant_in_channels(calibration.gain, sites);
}

Eigen::VectorXd channel_weights(const LinearProblem& problem) {
  std::vector<double> largest(problem.sites.back().channel + 1);
  for (std::size_t i = 0; i < problem.sites.size(); ++i) {
    double& weight = largest[problem.sites[i].channel];
    weight = std::max(weight, problem.weights[i]);
  }
  Eigen::VectorXd weights(std::ssize(problem.sites));
  for (std::size_t i = 0; i < problem.sites.size(); ++i) {
    const double weight = largest[problem.sites[i].channel];
    weights(static_cast<Eigen::Index>(i)) = weight > 0.0 ? weight : 1.0;
  }
  return weights;
}

std::vector<std::uint32_t> taxels_of_readings(const LinearProblem& problem) {
  const std::size_t channels = problem.sites.back().channel + 1;
  bool in_order = problem.sites.size() == channels * problem.taxels;
  std::vector<std::uint32_t> taxels;
  for (std::size_t i = 0; i < problem.sites.size(); ++i) {
    taxels.push_back(static_cast<std::uint32_t>(problem.sites[i].taxel));
    in_order = in_order && problem.sites[i].taxel == i % problem.taxels;
  }
  if (in_order) taxels.clear();
  return taxels;
}

void take_options(PlannedEstimator& planned, const PlannerOptions& options, bool unknown_offsets) {
  EstimatorPlan& plan = planned.plan;
  plan.label = options.label;
  plan.accuracy = options.accuracy;
  for (const Candidate& candidate : planned.candidates)
    if (candidate.chosen) plan.error_bound = candidate.error_bound;
  if (options.calibration) {
    for (std::size_t i = 0; i < plan.weights.size(); ++i)
      plan.weights[i] *= std::abs(options.calibration->gain[i]);
    plan.baseline = raw_baseline(*options.calibration);
  }
  plan.noise_rms = options.noise_rms;
  plan.traction_limit = options.traction_limit;
  if (options.diagnostics)
    for (const std::size_t value : options.border)
      plan.border.push_back(static_cast<std::uint32_t>(value));
  plan.known_offsets =
      options.judge_baseline && options.diagnostics && options.noise_rms > 0.0 && !unknown_offsets;
  plan.friction_coefficient = options.friction_coefficient;
  plan.ranges = options.ranges;
}

std::vector<double> leverages_of(const Eigen::MatrixXd& prediction) {
  constexpr double most = 1.0 - 1e-12;
  std::vector<double> leverages;
  for (Eigen::Index i = 0; i < prediction.rows(); ++i)
    leverages.push_back(std::clamp(prediction(i, i), 0.0, most));
  return leverages;
}

double noise_limit(const std::vector<double>& weights, std::size_t degrees) {
  const auto live = static_cast<double>(
      std::count_if(weights.begin(), weights.end(), [](double weight) { return weight > 0.0; }));
  return std::sqrt(chi_squared_quantile(static_cast<double>(degrees), 1e-3) / live);
}

PlanCells plan_cells(const LinearProblem& problem) {
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

std::optional<PlanSpace> plan_space(const LinearProblem& problem,
                                    const std::array<double, 3>& about) {
  if (!problem.cells) return std::nullopt;
  const std::vector<SurfaceCell>& cells = *problem.cells;
  const std::size_t tractions = problem.components * cells.size();
  PlanSpace space{.wrench = std::vector<double>(6 * tractions),
                  .places = std::vector<double>(3 * cells.size())};
  for (std::size_t at = 0; at < cells.size(); ++at) {
    for (std::size_t k = 0; k < 3; ++k)
      space.places[k * cells.size() + at] = cells[at].first_moment[k] / cells[at].area;
    for (std::size_t u = 0; u < problem.components; ++u) {
      const CellWrench of = cell_wrench(problem, at, u, about);
      const std::size_t traction = u * cells.size() + at;
      for (std::size_t k = 0; k < 3; ++k) {
        space.wrench[k * tractions + traction] = of.force[k];
        space.wrench[(3 + k) * tractions + traction] = of.moment[k];
      }
    }
  }
  return space;
}

void add_deviations(PlanCells& cells, const LinearProblem& problem,
                    const CellCovariance& covariance, double noise_rms) {
  const CellWindow window = window_of(problem.grid, least_depth(problem));
  cells.window_rows = window.rows;
  cells.window_columns = window.columns;
  cells.deviations = covariance.deviations();
  cells.deviations.resize(problem.grid.count());
  cells.window_deviations = covariance.window_deviations(problem.grid, window);
  for (std::vector<double>* deviations : {&cells.deviations, &cells.window_deviations})
    for (double& deviation : *deviations) deviation *= noise_rms;
}

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

}  // namespace tactile_net
