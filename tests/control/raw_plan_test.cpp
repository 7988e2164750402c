// Plans for raw numbers: the calibration is in the plan.
#include <cmath>
#include <string>
#include <vector>

#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tests/catch.hpp"
#include "tests/control/frames.hpp"

using namespace tactile_net;

namespace {

/// Counts per reading that differ from reading to reading, or from channel to channel alone.
Calibration calibration_of(const LinearProblem& problem, bool per_reading) {
  Calibration calibration;
  for (std::size_t i = 0; i < problem.weights.size(); ++i) {
    const auto channel = static_cast<double>(i / problem.grid.count());
    const auto taxel = static_cast<double>(i % problem.grid.count());
    const double size = per_reading ? 0.01 * (1.0 + 0.3 * std::sin(7.0 * taxel)) : 0.01;
    calibration.gain.push_back((i / problem.grid.count() % 2 == 1 ? -1.0 : 1.0) * size /
                               (1.0 + channel));
    calibration.baseline.push_back(512.0 + 3.0 * taxel);
    calibration.offset.push_back(0.01 * taxel);
  }
  return calibration;
}

struct Found {
  std::vector<double> tractions;
  ContactEstimate estimate;
};

Found found_of(ContactEstimator& estimator, const std::vector<double>& numbers) {
  Found found{std::vector<double>(estimator.tractions()), {}};
  found.estimate.tractions = found.tractions;
  REQUIRE(estimator.update(numbers, found.estimate) == FrameStatus::ok);
  return found;
}

}  // namespace

TEST_CASE("a plan for raw numbers finds in them what the plan for readings finds in readings",
          "[planner][calibration]") {
  const auto problems = sample_problems();
  const auto& [name, problem] = problems.at(GENERATE(range(std::size_t{0}, std::size_t{8})));
  const bool per_reading = GENERATE(false, true);
  const Calibration calibration = calibration_of(problem, per_reading);
  CAPTURE(name, per_reading);
  const PlannerOptions options{.accuracy = 1e-10, .noise_rms = 1e-3};
  PlannerOptions raw_options = options;
  raw_options.calibration = calibration;
  const PlannedEstimator planned = plan_estimator(problem, 1e-4, options);
  const PlannedEstimator raw_planned = plan_estimator(problem, 1e-4, raw_options);
  if (!per_reading)
    CHECK(raw_planned.plan.reconstruction.structure == planned.plan.reconstruction.structure);
  else
    CHECK_FALSE(has_reflections(raw_planned.plan.reconstruction.structure));

  ContactEstimator estimator(planned.plan);
  ContactEstimator raw_estimator(decode_plan(encode_plan(raw_planned.plan)));
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::vector<double> readings =
        seed % 2 == 0 ? contact_readings(problem, seed) : random_values(estimator.readings(), seed);
    if (seed == 2) readings[problem.grid.count() / 2] += 5.0;  // an outlier
    std::vector<double> raw = readings;
    uncalibrate(calibration, raw);
    const Found expected = found_of(estimator, readings);
    const Found found = found_of(raw_estimator, raw);
    // Both plans err by their accuracy; a count of 1000 is rounded at 1e-13 of it.
    CHECK(l2_norm(difference(found.tractions, expected.tractions)) <=
          1e-8 * l2_norm(expected.tractions));
    CHECK_THAT(found.estimate.residual_rms,
               WithinRel(expected.estimate.residual_rms, 1e-7) || WithinAbs(0.0, 1e-10));
    CHECK(found.estimate.outlier == expected.estimate.outlier);
    if (expected.estimate.contact && found.estimate.contact && expected.estimate.normal_force > 0.1)
      CHECK_THAT(found.estimate.centre,
                 WithinRel(expected.estimate.centre, 1e-6) || WithinAbs(0.0, 1e-6));
  }
}

TEST_CASE("a dead taxel at run time is left out of raw numbers too", "[planner][calibration]") {
  const LinearProblem problem = sample_problems().at(6).problem;
  const Calibration calibration = calibration_of(problem, true);
  ContactEstimator estimator(plan_estimator(problem, 1e-4, {.accuracy = 1e-10}).plan);
  ContactEstimator raw_estimator(
      plan_estimator(problem, 1e-4, {.accuracy = 1e-10, .calibration = calibration}).plan);
  REQUIRE(estimator.set_dead(11));
  REQUIRE(raw_estimator.set_dead(11));
  const std::vector<double> readings = contact_readings(problem, 2);
  std::vector<double> raw = readings;
  uncalibrate(calibration, raw);
  raw[11] = std::nan("");
  const Found expected = found_of(estimator, readings);
  const Found found = found_of(raw_estimator, raw);
  CHECK(l2_norm(difference(found.tractions, expected.tractions)) <=
        1e-7 * l2_norm(expected.tractions));
}

TEST_CASE("a baseline set at run time takes the place of the calibration's and its offset",
          "[planner][calibration]") {
  const LinearProblem problem = sample_problems().at(1).problem;
  const Calibration calibration = calibration_of(problem, true);
  ContactEstimator estimator(plan_estimator(problem, 1e-3, {.calibration = calibration}).plan);
  std::vector<double> unloaded(problem.weights.size(), 0.3);
  uncalibrate(calibration, unloaded);
  CHECK(l2_norm(found_of(estimator, unloaded).tractions) > 0.1);
  REQUIRE(estimator.set_baseline(unloaded) == FrameStatus::ok);
  for (const double f : found_of(estimator, unloaded).tractions) CHECK(f == 0.0);
}

TEST_CASE("plans for raw numbers refuse what they cannot do", "[planner][calibration]") {
  const LinearProblem problem = sample_problems().at(1).problem;
  Calibration calibration = calibration_of(problem, true);
  CHECK_THROWS_WITH(
      plan_estimator(problem, 1e-3,
                     {.structure = Structure::reflections, .calibration = calibration}),
      ContainsSubstring("not mirror symmetric (dead or uneven taxels, gains?)"));
  CHECK_NOTHROW(plan_estimator(
      problem, 1e-3, {.structure = Structure::fft, .calibration = calibration_of(problem, false)}));
  calibration.gain[4] = 0.0;
  CHECK_THROWS_AS(plan_estimator(problem, 1e-3, {.calibration = calibration}),
                  std::invalid_argument);
}
