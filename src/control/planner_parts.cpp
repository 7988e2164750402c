#include "control/planner_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "inverse/significance.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// Whether all readings of each channel have one gain.
bool is_constant_in_channels(const std::vector<double>& gain, std::size_t count) {
  for (std::size_t i = 0; i < gain.size(); ++i)
    if (gain[i] != gain[i - i % count]) return false;
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

}  // namespace

void check(const PlannerOptions& options, std::size_t readings) {
  if (!(options.accuracy > 0.0) || !std::isfinite(options.accuracy))
    throw std::invalid_argument("accuracy must be > 0 and finite");
  if (options.calibration) check(*options.calibration, readings);
}

void check_structure(const ProductTask& task, bool symmetric) {
  if (!task.structure) return;
  if (has_reflections(*task.structure) && !symmetric)
    throw std::invalid_argument(
        "the array is not mirror symmetric (dead or uneven taxels, gains?): " +
        std::string(name(*task.structure)) + " cannot be used");
  if (task.structure == Structure::fft && task.precision == Precision::float32)
    throw std::invalid_argument("fft has precision float64 only");
}

bool low_rank_pays(const std::vector<Candidate>& tried) {
  const auto cost_of = [&](Structure structure) {
    double cost = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : tried)
      if (candidate.structure == structure && !candidate.exchanged)
        cost = std::min(cost, candidate.cost);
    return cost;
  };
  return cost_of(Structure::reflections_low_rank) < cost_of(Structure::reflections);
}

bool is_better(const Candidate& one, const Candidate& other) {
  if (one.accurate != other.accurate) return one.accurate;
  return one.accurate ? one.cost < other.cost : one.error_bound < other.error_bound;
}

void take_raw(ProductTask& task, const Calibration& calibration, std::size_t count) {
  task.column_factors.array() *= as_eigen(std::span(calibration.gain)).array();
  task.symmetric = task.symmetric && is_constant_in_channels(calibration.gain, count);
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

}  // namespace tactile_net
