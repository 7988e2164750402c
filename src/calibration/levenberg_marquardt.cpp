#include "calibration/levenberg_marquardt.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace tactile_net {
namespace {

constexpr double first_damping = 1e-4;
constexpr double least_damping = 1e-14;
constexpr double most_damping = 1e8;
constexpr double enough = 1e-9;  // relative fall of the objective that ends the iteration
/// Also converged: `slow_steps` steps together reduced the objective (half the sum of squares) by
/// less than `slow_fall`. What is left of a narrow valley is a small part of a standard deviation.
constexpr std::size_t slow_steps = 10;
constexpr double slow_fall = 1e-3;
constexpr double longest_step = 1.0;  // of a logarithm
constexpr double known_share = 1e-7;  // another start's minimum, found again
constexpr std::size_t tries_a_step = 4;
/// A start whose residuals are still so many times the noise after so many steps goes nowhere.
constexpr std::size_t patience = 25;
constexpr double abandoned_rms = 5.0;

/// No logarithm moves by more than 1, no centre by more than the array's length over four.
double shortening(const FitProblem& problem, const Eigen::VectorXd& common,
                  const std::vector<std::array<double, press_unknowns>>& presses) {
  double most = 0.0;
  const auto take = [&](double step, double limit) {
    most = std::max(most, std::abs(step) / limit);
  };
  for (const PadParameter parameter : {PadParameter::depth, PadParameter::thickness,
                                       PadParameter::youngs_modulus, PadParameter::pitch})
    if (const std::size_t column = problem.pad_column(parameter); column != no_column)
      take(common(static_cast<Eigen::Index>(column)), longest_step);
  const double longest =
      std::max(problem.last().y - problem.first().y, problem.last().z - problem.first().z);
  const double length = std::max(0.25 * longest, problem.model().depth());
  for (const auto& step : presses) {
    take(step[0], longest_step);
    take(step[1], length);
    take(step[2], longest_step);
    take(step[4], length);
  }
  return most > 1.0 ? 1.0 / most : 1.0;
}

}  // namespace

SystemParts active_bounds(const FitProblem& problem, const FitState& state,
                          const SystemColumns& columns) {
  SystemParts parts;
  const auto slope = [&](PadParameter parameter) {
    return columns.gradient(static_cast<Eigen::Index>(problem.pad_column(parameter)));
  };
  for (std::size_t i = 0; i < pad_parameter_count; ++i) {
    const auto parameter = static_cast<PadParameter>(i);
    if (problem.pad_column(parameter) == no_column) continue;
    const FitProblem::Range& range = problem.range(parameter);
    const double value = value_of(state.pad, parameter);
    parts.frozen[i] = (value >= range.high && slope(parameter) < 0.0) ||
                      (value <= range.low && slope(parameter) > 0.0);
  }
  if (problem.pad_column(PadParameter::thickness) != no_column) {
    parts.thickness_follows =
        problem.log_room(state.pad) < 1e-12 && slope(PadParameter::thickness) > 0.0;
    if (parts.thickness_follows)
      parts.frozen[static_cast<std::size_t>(PadParameter::thickness)] = false;
  }
  return parts;
}

Descent descend(const FitProblem& problem, FitState state, std::optional<PadParameter> held,
                double known) {
  Descent descent;
  PressReadings readings = problem.readings(state, true);
  double objective = problem.objective(state, readings);
  double damping = first_damping;
  const std::size_t most_tries = tries_a_step * problem.options().most_iterations;
  std::size_t tries = 0;
  std::vector<double> objectives{objective};
  const auto rows = static_cast<double>(state.presses.size() * problem.readings_used());
  while (descent.iterations < problem.options().most_iterations && !descent.converged &&
         tries < most_tries) {
    if (descent.iterations >= patience && objective > 0.5 * abandoned_rms * abandoned_rms * rows)
      break;
    ++descent.iterations;
    if (problem.watch) problem.watch(descent.iterations);
    const SystemColumns columns = system_columns(problem, state, readings);
    SystemParts parts = active_bounds(problem, state, columns);
    if (held) parts.frozen[static_cast<std::size_t>(*held)] = true;
    for (; tries < most_tries; ++tries) {
      parts.damping = damping;
      auto [common, steps] = fit_step(problem, state, readings, columns, parts);
      if (parts.thickness_follows)
        common(static_cast<Eigen::Index>(problem.pad_column(PadParameter::thickness))) =
            problem.pad_column(PadParameter::depth) == no_column
                ? 0.0
                : common(static_cast<Eigen::Index>(problem.pad_column(PadParameter::depth)));
      const double share = shortening(problem, common, steps);
      common *= share;
      for (auto& step : steps)
        for (double& value : step) value *= share;
      FitState trial = problem.moved(state, common, steps);
      PressReadings at = problem.readings(trial, false);
      const double reached = problem.objective(trial, at);
      if (std::isfinite(reached) && reached <= objective) {
        const double fall = objective - reached;
        descent.converged = share == 1.0 && fall <= enough * objective && damping <= 1e-3;
        if (known > 0.0 && std::abs(reached - known) <= known_share * known)
          descent.converged = true;
        objectives.push_back(reached);
        if (objectives.size() > slow_steps &&
            objectives[objectives.size() - 1 - slow_steps] - reached <= slow_fall)
          descent.converged = true;
        state = std::move(trial);
        objective = reached;
        damping = std::max(least_damping, damping * (share == 1.0 ? 0.02 : 0.3));
        ++tries;
        break;
      }
      if (damping >= most_damping) {  // nothing near is lower: rounding is all that is left
        descent.converged = true;
        break;
      }
      damping = std::max(damping * 20.0, 1e-8);
    }
    if (!descent.converged) readings = problem.readings(state, true);
  }
  descent.state = std::move(state);
  descent.objective = objective;
  return descent;
}

}  // namespace tactile_net
