// Plans of problems whose channels have a constant that nobody knows.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/control/skin_planner.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/control/frames.hpp"
#include "tests/control/skins.hpp"

using namespace tactile_net;

namespace {

constexpr double sigma = 1e-3;

LinearProblem problem_without(std::vector<std::size_t> dead) {
  using enum Quantity;
  return make_problem({31, 0.5, {1.0}, {stress_x, shear_xy}}, {1.0, 0.45},
                      {.unknowns = 2,
                       .smoothing_length = 1.0,
                       .dead_taxels = std::move(dead),
                       .unknown_offsets = true});
}

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

}  // namespace

TEST_CASE("a controller with unknown offsets answers and judges as if there were none",
          "[planner][offset]") {
  const LinearProblem problem = problem_without({});
  const PlannedEstimator planned =
      plan_estimator(problem, 1e-6, {.accuracy = 1e-9, .noise_rms = sigma});
  ContactEstimator estimator(planned.plan);
  const Estimate plain = estimated(estimator, frame(problem, 0.0));
  const double offset = GENERATE(0.2, 30.0);
  CAPTURE(offset);
  const Estimate moved = estimated(estimator, frame(problem, offset));
  CHECK(relative_l2_error(moved.tractions, plain.tractions) < 1e-6);
  CHECK_THAT(moved.contact.normal_force, WithinRel(plain.contact.normal_force, 1e-6));
  CHECK_THAT(moved.contact.residual_rms, WithinRel(plain.contact.residual_rms, 1e-3));
  for (const Estimate* one : {&plain, &moved}) {
    CHECK(one->contact.residual_rms < planned.plan.residual_limit);
    CHECK_FALSE(one->contact.misfit);
    CHECK(one->contact.outlier == -1);
  }

  // By a plan that takes offsets for known the same frame is nothing that a contact explains.
  LinearProblem known = make_problem({31, 0.5, {1.0}, {Quantity::stress_x, Quantity::shear_xy}},
                                     {1.0, 0.45}, {.unknowns = 2, .smoothing_length = 1.0});
  ContactEstimator other(plan_estimator(known, 1e-6, {.noise_rms = sigma}).plan);
  CHECK(relative_l2_error(estimated(other, frame(problem, offset)).tractions, plain.tractions) >
        0.1);
}

TEST_CASE("one bad reading is told from its channel's offset", "[planner][offset]") {
  const LinearProblem problem = problem_without({});
  ContactEstimator estimator(
      plan_estimator(problem, 1e-6, {.accuracy = 1e-9, .noise_rms = sigma}).plan);
  std::vector<double> g = frame(problem, 5.0);
  g[12] += 60.0 * sigma;
  CHECK(estimated(estimator, g).contact.outlier == 12);
}

TEST_CASE("a taxel that dies later leaves its channels' offsets to the others",
          "[planner][offset]") {
  ContactEstimator estimator(
      plan_estimator(problem_without({}), 1e-4, {.accuracy = 1e-10, .noise_rms = sigma}).plan);
  std::vector<double> g = frame(problem_without({}), 0.5);
  for (const std::size_t reading : {std::size_t{8}, std::size_t{39}}) g[reading] = 7.0;
  REQUIRE(estimator.set_dead(8));
  const Estimate later = estimated(estimator, g);

  ContactEstimator fresh(
      plan_estimator(problem_without({8}), 1e-4, {.accuracy = 1e-10, .noise_rms = sigma}).plan);
  const Estimate expected = estimated(fresh, g);
  CHECK(relative_l2_error(later.tractions, expected.tractions) < 1e-6);
  CHECK_THAT(later.contact.residual_rms, WithinRel(expected.contact.residual_rms, 1e-5));
}

namespace {

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

}  // namespace

TEST_CASE("a skin's plan with unknown offsets is the solver's answer, and judges it alike",
          "[skin_plan][offset]") {
  const double alpha = 1e-4;
  for (const std::vector<std::size_t>& dead : {std::vector<std::size_t>{}, {14}, {0, 7, 21, 22}}) {
    const Skin skin = skin_without(dead);
    const SkinFamily family(skin.problem);
    const PlannerOptions options{.accuracy = 1e-9, .noise_rms = skin_noise};
    for (const bool whole_known : {true, false}) {
      if (dead.empty() && !whole_known) continue;
      CAPTURE(dead, whole_known);
      const PlannedEstimator planned = plan_estimator(
          skin.problem, family, alpha, options, whole_known && skin.whole ? &*skin.whole : nullptr);
      // Whoever knows the whole skin keeps its symmetry.
      CHECK(has_reflections(planned.plan.reconstruction.structure) == whole_known);
      CHECK(has_reflections(planned.plan.prediction->structure) == whole_known);
      ContactEstimator estimator(planned.plan);
      std::vector<double> plain;
      for (const double offset : {0.0, 0.2, 30.0}) {
        CAPTURE(offset);
        std::vector<double> g = skin_frame(skin, offset);
        std::vector<double> live = g;
        for (std::size_t i = 0; i < g.size(); ++i)
          if (skin.problem.weights[i] == 0.0) {
            g[i] = std::numeric_limits<double>::quiet_NaN();
            live[i] = 0.0;
          }
        const std::vector<double> exact = family.solve(family.analyse(live), alpha);
        const Estimate found = estimated(estimator, g);
        CHECK(relative_l2_error(found.tractions, exact) < 1e-6);

        const std::vector<double> rows = weighted(skin.problem, live);
        double squares = 0.0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
          double left = rows[i];
          for (std::size_t j = 0; j < exact.size(); ++j)
            left -= skin.problem.kernel(i, j) * exact[j];
          squares += left * left;
        }
        const auto dead_rows = static_cast<double>(3 * dead.size());
        const double rms = std::sqrt(squares / (static_cast<double>(rows.size()) - dead_rows));
        CHECK_THAT(found.contact.residual_rms, WithinRel(rms, 1e-4));
        CHECK(found.contact.residual_rms < planned.plan.residual_limit);
        CHECK_FALSE(found.contact.misfit);
        CHECK(found.contact.outlier == -1);
        if (plain.empty()) plain = found.tractions;
        CHECK(relative_l2_error(found.tractions, plain) < 1e-6);
      }
    }
  }
}

TEST_CASE("a skin's taxel that dies later leaves its channels' offsets to the others",
          "[skin_plan][offset]") {
  const auto planned = [](const Skin& skin) {
    return plan_estimator(skin.problem, SkinFamily(skin.problem), 1e-4,
                          {.accuracy = 1e-10, .noise_rms = skin_noise},
                          skin.whole ? &*skin.whole : nullptr)
        .plan;
  };
  const Skin whole = skin_without({});
  ContactEstimator estimator(planned(whole));
  const std::vector<double> g = skin_frame(whole, 3.0);
  REQUIRE(estimator.set_dead(15));
  const Estimate later = estimated(estimator, g);
  ContactEstimator fresh(planned(skin_without({15})));
  const Estimate expected = estimated(fresh, g);
  CHECK(relative_l2_error(later.tractions, expected.tractions) < 1e-5);
  CHECK_THAT(later.contact.residual_rms, WithinRel(expected.contact.residual_rms, 1e-4));
}

TEST_CASE("a whole skin whose offsets are known is no part of one whose are not",
          "[skin_plan][offset]") {
  const Skin skin = skin_without({14});
  const LinearProblem known = make_problem(skin.array, skin.material);
  CHECK_THROWS_AS(plan_estimator(skin.problem, SkinFamily(skin.problem), 1e-4, {}, &known),
                  std::invalid_argument);
}
