/// @file
/// Lines and skins that plans are made for, their dense answers, and what a plan promises of them.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/control/frames.hpp"
#include "tests/control/skins.hpp"

namespace tactile_net {

/// A line on a pad of modulus 1.
inline PlanCase line_of(const std::string& name, const SensorArray& array,
                        LineProblemOptions options) {
  const Material material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};
  PlanCase line{.name = name, .problem = make_problem(array, material, options)};
  if (options.dead_taxels.empty()) return line;
  options.dead_taxels.clear();
  line.whole = make_problem(array, material, options);
  return line;
}

/// 31 taxels that read two stresses, dense.
inline PlanCase dense_line(std::vector<std::size_t> dead, bool unknown_offsets = false) {
  return line_of("dense line", {31, 0.5, {1.0}, {Quantity::stress_x, Quantity::shear_xy}},
                 {.unknowns = 2,
                  .smoothing_length = 1.0,
                  .dead_taxels = std::move(dead),
                  .unknown_offsets = unknown_offsets});
}

/// Few taxels under a finer surface that reaches beyond them; weighted.
inline PlanCase coarse_line(std::vector<std::size_t> dead) {
  return line_of("coarse line", {9, 2.0, {1.0}, {Quantity::stress_x, Quantity::strain_x}},
                 {.smoothing_length = 1.0,
                  .channel_rms = {2.0, 0.1},
                  .dead_taxels = std::move(dead),
                  .surface = {.basis = SurfaceBasis::hats, .spacing = 0.5, .margin = 1.0}});
}

inline bool is_skin(const PlanCase& sensor) { return !sensor.problem.is_line; }

/// M itself, by a solver that knows no plan.
inline Reconstruction dense_answer(const LinearProblem& problem, double alpha) {
  return problem.is_line ? tikhonov(problem, alpha) : TikhonovFamily(problem).reconstruction(alpha);
}

inline PlannedEstimator planned(const PlanCase& sensor, double alpha,
                                const PlannerOptions& options = {}) {
  return plan_estimator(sensor.problem, alpha, options, sensor.whole ? &*sensor.whole : nullptr);
}

/// What a controller answers: it must not look at what dead taxels read.
inline std::vector<double> answer_of(const PlanCase& sensor, const EstimatorPlan& plan,
                                     std::vector<double> readings) {
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (sensor.problem.weights[i] == 0.0)
      readings[i] = i % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : 1e250;
  ContactEstimator estimator(plan, fft_convolutions());
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
  return f;
}

/// |planned - dense| over what the plan has proven for this frame.
inline double share_of_promise(const PlanCase& sensor, const EstimatorPlan& plan,
                               const Reconstruction& dense, std::vector<double> readings) {
  const std::vector<double> f = answer_of(sensor, plan, readings);
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (sensor.problem.weights[i] == 0.0) readings[i] = 0.0;
  std::vector<double> exact(dense.tractions());
  REQUIRE(dense.solve(readings, exact) == FrameStatus::ok);
  // Of M, to which a line's dense answer comes by another way.
  const double rounding = is_skin(sensor) ? 1e-11
                                          : forward_bound(sensor.problem, plan.alpha, readings,
                                                          exact, dense.condition());
  return l2_norm(difference(f, exact)) /
         (plan.error_bound * unit_of_error(sensor.problem, dense, readings, exact) +
          rounding * l2_norm(exact));
}

/// Contacts, some of them at the very edge, and noise alone.
inline std::vector<double> frame_for(const PlanCase& sensor, unsigned seed) {
  if (is_skin(sensor)) return frame_of(sensor.problem, seed);
  return seed % 2 == 0 ? contact_readings(sensor.problem, seed)
                       : random_values(sensor.problem.kernel.rows, seed);
}

/// The structure that was chosen, in words.
inline std::string choice(const PlannedEstimator& planned) {
  for (const Candidate& candidate : planned.candidates)
    if (candidate.chosen)
      return std::string(name(candidate.structure)) + (candidate.exchanged ? " and exchange" : "");
  return {};
}

}  // namespace tactile_net
