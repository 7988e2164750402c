// Frames that cannot be true, as a controller with a planned estimator meets them.
#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/control/pad.hpp"

using namespace tactile_net;

namespace {

constexpr double noise_rms = 1e-3;
const SensorArray pad_array{
    .count = 41, .pitch = 0.5, .depths = {1.5}, .reads = {Quantity::stress_x}};

EstimatorPlan plan_with(const PlannerOptions& options) {
  const LinearProblem problem = make_problem(pad_array, pad, {.smoothing_length = 1.5});
  return plan_estimator(problem, pad_alpha, options).plan;
}

EstimatorPlan whole_plan() {
  return plan_with({.noise_rms = noise_rms, .traction_limit = 1.0, .judge_baseline = true});
}

std::vector<double> frame(std::size_t number) {
  const std::vector<Contact> contacts = {
      RigidContact{.center = 0.3, .half_width = 2.0, .force = 0.4}};
  std::vector<double> readings = exact_readings(pad_array, pad, contacts);
  add_noise(readings, noise_rms, number, 0);
  return readings;
}

struct Flags {
  bool pulls = false, implausible = false, misfit = false;
  bool operator==(const Flags&) const = default;
};

Flags flags(const EstimatorPlan& plan, const std::vector<double>& readings) {
  ContactEstimator estimator(plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
  return {estimate.pulls, estimate.implausible, estimate.misfit};
}

}  // namespace

TEST_CASE("an estimator has no doubts about frames of contacts, nor of noise", "[planner]") {
  const EstimatorPlan plan = whole_plan();
  for (std::size_t k = 0; k < 200; ++k) {
    CHECK(flags(plan, frame(k)) == Flags{});
    std::vector<double> readings(41);
    add_noise(readings, noise_rms, k, 0);
    CHECK(flags(plan, readings) == Flags{});
  }
}

TEST_CASE("an estimator doubts the sign, the unit and single taxels", "[planner]") {
  const EstimatorPlan plan = whole_plan();
  std::vector<double> readings = frame(1);
  for (double& reading : readings) reading = -reading;
  CHECK(flags(plan, readings) == Flags{.pulls = true});
  for (double& reading : readings) reading *= -1e4;
  CHECK(flags(plan, readings).implausible);
  readings = frame(2);
  readings[21] = 0.0;
  CHECK(flags(plan, readings) == Flags{.misfit = true});
}

TEST_CASE("what a plan does not have, its frames are not doubted by", "[planner]") {
  std::vector<double> readings = frame(1);
  for (double& reading : readings) reading *= -1e4;
  readings[21] = 0.0;
  CHECK(flags(whole_plan(), readings) == Flags{true, true, true});
  CHECK(flags(plan_with({}), readings) == Flags{});
  CHECK(flags(plan_with({.traction_limit = 1.0}), readings) == Flags{.implausible = true});
  CHECK(flags(plan_with({.diagnostics = false, .noise_rms = noise_rms}), readings) ==
        Flags{.pulls = true});
}

namespace {

ContactEstimate estimate_of(const EstimatorPlan& plan, const std::vector<double>& readings) {
  ContactEstimator estimator(plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
  estimate.tractions = {};
  return estimate;
}

std::vector<double> noisy(std::vector<double> readings, std::size_t number) {
  add_noise(readings, noise_rms, number, 0);
  return readings;
}

}  // namespace

TEST_CASE("what presses at the outermost taxels may press beyond them", "[planner]") {
  const EstimatorPlan plan = plan_with({.noise_rms = noise_rms, .border = {0, 40}});
  const auto pressed_at = [&](double center) {
    const std::vector<Contact> contacts = {
        RigidContact{.center = center, .half_width = 2.0, .force = 0.4}};
    return estimate_of(plan, noisy(exact_readings(pad_array, pad, contacts), 3));
  };
  for (const double side : {-1.0, 1.0}) {
    CHECK(pressed_at(side * 10.0).beyond_edge);       // its middle is above the last taxel
    CHECK_FALSE(pressed_at(side * 7.5).beyond_edge);  // it ends inside
  }
  CHECK_FALSE(pressed_at(0.0).beyond_edge);
  for (std::size_t k = 0; k < 100; ++k)
    CHECK_FALSE(estimate_of(plan, noisy(std::vector<double>(41), k)).beyond_edge);
  CHECK(estimate_of(plan, frame(1)).force_deviation == plan.force_deviation);
  CHECK(plan_with({.diagnostics = false, .border = {0, 40}}).border.empty());
  CHECK_THROWS_AS(plan_with({.border = {0, 41}}), std::invalid_argument);
}

TEST_CASE("a baseline that moved presses, and is doubted", "[planner]") {
  const EstimatorPlan plan = whole_plan();
  const LinearProblem with_offsets =
      make_problem(pad_array, pad, {.smoothing_length = 1.5, .unknown_offsets = true});
  const EstimatorPlan freed =
      plan_estimator(with_offsets, pad_alpha, {.noise_rms = noise_rms, .judge_baseline = true})
          .plan;
  for (std::size_t k = 0; k < 50; ++k) {
    const double side = k % 2 == 0 ? 1.0 : -1.0;
    const std::vector<double> moved = noisy(std::vector<double>(41, side * 10.0 * noise_rms), k);
    CHECK(estimate_of(plan, moved).baseline_moved);
    CHECK_FALSE(estimate_of(freed, moved).baseline_moved);
    CHECK_FALSE(estimate_of(plan, frame(k)).baseline_moved);
    CHECK_FALSE(estimate_of(plan, noisy(std::vector<double>(41), k)).baseline_moved);
    // An unloaded frame is the new baseline.
    ContactEstimator estimator(plan);
    std::vector<double> f(estimator.tractions());
    ContactEstimate estimate{.tractions = f};
    REQUIRE(estimator.set_baseline(std::vector<double>(41, side * 10.0 * noise_rms)) ==
            FrameStatus::ok);
    REQUIRE(estimator.update(moved, estimate) == FrameStatus::ok);
    CHECK_FALSE(estimate.baseline_moved);
  }
}

TEST_CASE("the deviation of a plan's force is that of the noise and of the smoothing",
          "[planner]") {
  const EstimatorPlan plan = whole_plan();
  const EstimatorPlan noisier = plan_with({.noise_rms = 3.0 * noise_rms});
  CHECK_THAT(noisier.force_deviation, WithinRel(3.0 * plan.force_deviation, 1e-9));
  CHECK_THAT(noisier.residual_limit, WithinRel(3.0 * plan.residual_limit, 1e-12));
  // 99.9 % of chi squared with 41 degrees of freedom is 74.745.
  CHECK_THAT(plan.residual_limit, WithinRel(noise_rms * std::sqrt(74.745 / 41.0), 1e-4));
}

TEST_CASE("a plan's limits survive its file, and have a version of their own", "[planner]") {
  const EstimatorPlan plan = whole_plan();
  const std::vector<std::byte> bytes = encode_plan(plan);
  CHECK(bytes[8] == std::byte{9});  // as of all reflections of lines
  const auto version_of_dense = [](double noise) {
    return encode_plan(
        plan_with({.structure = Structure::dense, .diagnostics = false, .noise_rms = noise}))[8];
  };
  CHECK(version_of_dense(noise_rms) == std::byte{4});
  CHECK(version_of_dense(0.0) == std::byte{1});
  const EstimatorPlan again = decode_plan(bytes);
  CHECK(again.residual_limit == plan.residual_limit);
  CHECK(again.traction_limit == plan.traction_limit);
  CHECK(again.force_deviation == plan.force_deviation);
  CHECK(encode_plan(again) == bytes);

  EstimatorPlan bad = plan;
  bad.force_deviation = -1.0;
  CHECK_THROWS_AS(encode_plan(bad), std::invalid_argument);
}
