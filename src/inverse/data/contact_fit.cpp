#include "inverse/data/contact_fit.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/significance.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

JudgedProblem::JudgedProblem(const LinearProblem& of, DataLimits given)
    : problem(of),
      limits(std::move(given)),
      unit(limits.noise_rms.value_or(1.0)),
      rows(static_cast<double>(independent_readings(of))),
      most(limit(0.0)) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  const auto require = [](bool holds, const char* rule) {
    if (!holds) throw std::invalid_argument(rule);
  };
  const std::vector<double>& largest = limits.largest_readings;
  require(positive(unit), "noise_rms must be > 0 and finite");
  check_friction_limit(limits.friction_limit.value_or(1.0));
  require(positive(limits.largest_traction.value_or(1.0)),
          "largest_traction must be > 0 and finite");
  require(largest.empty() || (largest.size() == of.weights.size() &&
                              std::all_of(largest.begin(), largest.end(), positive)),
          "largest_readings needs one value > 0 per row, or none");
}

std::optional<double> JudgedProblem::limit_of(Friction friction) const noexcept {
  if (problem.components == 1) return std::nullopt;
  if (friction == Friction::stated) return limits.friction_limit.value_or(usual_friction);
  return std::max(usual_friction, 2.0 * limits.friction_limit.value_or(0.0));
}

std::vector<double> JudgedProblem::pressing(Friction friction,
                                            std::span<const double> tractions) const {
  std::vector<double> contact(tractions.begin(), tractions.end());
  const std::optional<double> share = limit_of(friction);
  const std::size_t places = problem.grid.count();
  for (std::size_t i = 0; i < places; ++i) {
    contact[i] = std::max(contact[i], 0.0);
    if (!share) continue;
    const double largest = *share * contact[i];
    double& y = contact[places + i];
    if (problem.components == 2) {
      y = std::clamp(y, -largest, largest);
      continue;
    }
    double& z = contact[2 * places + i];
    const double drag = std::hypot(y, z);
    if (drag <= largest) continue;
    y *= largest / drag;
    z *= largest / drag;
  }
  return contact;
}

double JudgedProblem::limit(double taken) const {
  return std::sqrt(chi_squared_quantile(std::max(rows - taken, 1.0), false_alarms));
}

void check_contacts(const LinearProblem& problem, const LinearProblem& contacts) {
  if (contacts.weights != problem.weights || contacts.components != problem.components ||
      contacts.is_line != problem.is_line || contacts.unknown_offsets != problem.unknown_offsets)
    throw std::invalid_argument(
        "contacts need the rows and components of the problem: make both of the same sensor and "
        "options, and let them differ in the grid alone");
}

JudgedFrame judged_frame(const LinearProblem& of, double unit, std::span<const double> readings) {
  JudgedFrame frame{readings, weighted(of, readings), {}};
  frame.seen = frame.rows;
  for (double& reading : frame.seen) reading /= unit;
  return frame;
}

std::vector<double> negated(std::span<const double> values) {
  std::vector<double> all(values.begin(), values.end());
  for (double& value : all) value = -value;
  return all;
}

Unexplained nothing_explained(const JudgedFrame& frame, Friction friction) {
  return {
      .residual = frame.seen, .norm = as_eigen(std::span(frame.seen)).norm(), .friction = friction};
}

Unexplained left_by_tractions(const LinearProblem& of, double unit, const JudgedFrame& frame,
                              std::span<const double> tractions) {
  const Eigen::VectorXd residual =
      (as_eigen(frame.rows) - as_eigen(of.kernel) * as_eigen(tractions)) / unit;
  return {.residual = {residual.begin(), residual.end()}, .norm = residual.norm()};
}

}  // namespace tactile_net
