// Plans of problems whose channels have a constant that nobody knows.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/control/plan_cases.hpp"

using namespace tactile_net;

namespace {

constexpr double sigma = 1e-3;

struct Estimate {
  explicit Estimate(const ContactEstimator& estimator) : tractions(estimator.tractions()) {}
  std::vector<double> tractions;
  ContactEstimate contact{.tractions = tractions};
};

Estimate estimated(ContactEstimator& estimator, const std::vector<double>& g) {
  Estimate estimate(estimator);
  REQUIRE(estimator.update(g, estimate.contact) == FrameStatus::ok);
  return estimate;
}

/// A contact with noise, and offsets of many times its size.
std::vector<double> frame(const LinearProblem& problem, double offset) {
  std::vector<double> g = contact_readings(problem, 2);
  std::mt19937 generator(9);
  std::normal_distribution<double> normal(0.0, sigma);
  for (std::size_t i = 0; i < g.size(); ++i)
    g[i] += normal(generator) + (problem.sites[i].channel == 0 ? offset : -2.0 * offset);
  return g;
}

constexpr double skin_noise = 50.0;  // of some 5 kPa

Skin skin_without(std::vector<std::size_t> dead) {
  return skin_of("offsets", square(6).array,
                 {.dead_taxels = std::move(dead), .unknown_offsets = true});
}

/// A contact that drags, with noise, and offsets of so many times its peak.
std::vector<double> skin_frame(const Skin& skin, double offset) {
  const LinearProblem known = make_problem(skin.array, skin.material);
  const std::size_t cells = known.grid.count();
  std::vector<double> f(known.kernel.columns);
  for (std::size_t i = 0; i < cells; ++i) {
    const double y = known.grid.y(i / known.grid.columns) - 0.5e-3;
    const double z = known.grid.z(i % known.grid.columns) + 1e-3;
    f[i] = 1e4 * std::sqrt(std::max(1.0 - (y * y + z * z) / 16e-6, 0.0));
    f[i + cells] = 0.3 * f[i];
  }
  std::vector<double> g(known.kernel.rows);
  for (std::size_t i = 0; i < g.size(); ++i)
    for (std::size_t j = 0; j < f.size(); ++j) g[i] += known.kernel(i, j) * f[j];
  const double peak = *std::max_element(g.begin(), g.end());
  std::mt19937 generator(4);
  std::normal_distribution<double> normal(0.0, skin_noise);
  const double of_channel[] = {1.0, -2.0, 0.5};
  for (std::size_t i = 0; i < g.size(); ++i)
    g[i] += normal(generator) + offset * peak * of_channel[known.sites[i].channel];
  return g;
}

/// A line or a skin, and frames of a contact with noise and offsets of so many times its readings.
struct OffsetCase {
  PlanCase sensor{};
  double alpha = 0.0;
  double noise = 0.0;
  std::function<std::vector<double>(double offset)> frame{};
};

OffsetCase line_case(std::vector<std::size_t> dead) {
  return {.sensor = dense_line(std::move(dead), true),
          .alpha = 1e-6,
          .noise = sigma,
          .frame = [](double offset) { return frame(dense_line({}, true).problem, offset); }};
}

OffsetCase skin_case(std::vector<std::size_t> dead) {
  return {.sensor = skin_without(std::move(dead)),
          .alpha = 1e-4,
          .noise = skin_noise,
          .frame = [](double offset) { return skin_frame(skin_without({}), offset); }};
}

/// By the plan's problem, of what its tractions leave of the live readings.
double residual_rms(const LinearProblem& problem, const std::vector<double>& readings,
                    const std::vector<double>& tractions) {
  const auto live =
      static_cast<double>(std::ssize(problem.weights) -
                          std::count(problem.weights.begin(), problem.weights.end(), 0.0));
  return residual_norm(problem, readings, tractions) / std::sqrt(live);
}

}  // namespace

TEST_CASE("a plan with unknown offsets is the solver's answer, and judges it alike",
          "[planner][offset]") {
  for (const OffsetCase& one :
       {line_case({}), line_case({8}), skin_case({}), skin_case({14}), skin_case({0, 7, 21, 22})})
    for (const bool whole_known : {true, false}) {
      PlanCase sensor = one.sensor;
      if (!sensor.whole && !whole_known) continue;
      if (!whole_known) sensor.whole.reset();
      CAPTURE(sensor.name, sensor.whole.has_value(), whole_known);
      const PlannedEstimator made =
          planned(sensor, one.alpha, {.accuracy = 1e-9, .noise_rms = one.noise});
      // Whoever knows the whole keeps its symmetry.
      CHECK(has_reflections(made.plan.reconstruction.structure) == whole_known);
      CHECK(has_reflections(made.plan.prediction->structure) == whole_known);
      ContactEstimator estimator(made.plan);
      const Reconstruction solver = dense_answer(sensor.problem, one.alpha);
      std::vector<double> plain;
      for (const double offset : {0.0, 0.2, 30.0}) {
        CAPTURE(offset);
        std::vector<double> g = one.frame(offset);
        std::vector<double> live = g;
        for (std::size_t i = 0; i < g.size(); ++i)
          if (sensor.problem.weights[i] == 0.0) {
            g[i] = std::numeric_limits<double>::quiet_NaN();
            live[i] = 0.0;
          }
        std::vector<double> exact(solver.tractions());
        REQUIRE(solver.solve(live, exact) == FrameStatus::ok);
        const Estimate found = estimated(estimator, g);
        CHECK(relative_l2_error(found.tractions, exact) < 1e-6);
        const double rms = residual_rms(sensor.problem, live, exact);
        CHECK_THAT(found.contact.residual_rms, WithinRel(rms, 1e-3));
        CHECK(found.contact.residual_rms < made.plan.residual_limit);
        CHECK_FALSE(found.contact.misfit);
        CHECK(found.contact.outlier == -1);
        if (plain.empty()) plain = found.tractions;
        CHECK(relative_l2_error(found.tractions, plain) < 1e-6);
      }
    }
}

TEST_CASE("by a plan that takes offsets for known a frame with some is no contact's",
          "[planner][offset]") {
  const LinearProblem problem = dense_line({}, true).problem;
  ContactEstimator estimator(plan_estimator(problem, 1e-6, {.accuracy = 1e-9}).plan);
  ContactEstimator other(plan_estimator(dense_line({}).problem, 1e-6, {.noise_rms = sigma}).plan);
  const Estimate plain = estimated(estimator, frame(problem, 0.0));
  for (const double offset : {0.2, 30.0})
    CHECK(relative_l2_error(estimated(other, frame(problem, offset)).tractions, plain.tractions) >
          0.1);
}

TEST_CASE("one bad reading is told from its channel's offset", "[planner][offset]") {
  const LinearProblem problem = dense_line({}, true).problem;
  ContactEstimator estimator(
      plan_estimator(problem, 1e-6, {.accuracy = 1e-9, .noise_rms = sigma}).plan);
  std::vector<double> g = frame(problem, 5.0);
  g[12] += 60.0 * sigma;
  CHECK(estimated(estimator, g).contact.outlier == 12);
}

TEST_CASE("a taxel that dies later leaves its channels' offsets to the others",
          "[planner][offset]") {
  const bool skin = GENERATE(false, true);
  const std::size_t dead = skin ? 15 : 8;
  const auto with = [&](std::vector<std::size_t> taxels) {
    return skin ? skin_case(std::move(taxels)) : line_case(std::move(taxels));
  };
  const OffsetCase whole = with({});
  const PlannerOptions options{.accuracy = 1e-10, .noise_rms = whole.noise};
  ContactEstimator estimator(planned(whole.sensor, 1e-4, options).plan);
  std::vector<double> g = whole.frame(3.0);
  for (std::size_t i = 0; i < g.size(); ++i)
    if (whole.sensor.problem.sites[i].taxel == dead) g[i] = 7.0;
  REQUIRE(estimator.set_dead(dead));
  const Estimate later = estimated(estimator, g);
  ContactEstimator fresh(planned(with({dead}).sensor, 1e-4, options).plan);
  const Estimate expected = estimated(fresh, g);
  CHECK(relative_l2_error(later.tractions, expected.tractions) < 1e-5);
  CHECK_THAT(later.contact.residual_rms, WithinRel(expected.contact.residual_rms, 1e-4));
}

TEST_CASE("a whole whose offsets are known is no part of one whose are not", "[planner][offset]") {
  for (const OffsetCase& one : {skin_case({14}), line_case({8})}) {
    const LinearProblem known = is_skin(one.sensor) ? square(6).problem : dense_line({}).problem;
    CHECK_THROWS_AS(plan_estimator(one.sensor.problem, 1e-4, {}, &known), std::invalid_argument);
  }
}
