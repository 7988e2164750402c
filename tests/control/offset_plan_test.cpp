// Plans of problems whose channels have a constant that nobody knows.
#include <cmath>
#include <random>
#include <vector>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/control/frames.hpp"

using namespace tactile_net;

namespace {

constexpr double sigma = 1e-3;

InverseProblem problem_without(std::vector<std::size_t> dead) {
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
std::vector<double> frame(const InverseProblem& problem, double offset) {
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
  const InverseProblem problem = problem_without({});
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
  InverseProblem known = make_problem({31, 0.5, {1.0}, {Quantity::stress_x, Quantity::shear_xy}},
                                      {1.0, 0.45}, {.unknowns = 2, .smoothing_length = 1.0});
  ContactEstimator other(plan_estimator(known, 1e-6, {.noise_rms = sigma}).plan);
  CHECK(relative_l2_error(estimated(other, frame(problem, offset)).tractions, plain.tractions) >
        0.1);
}

TEST_CASE("one bad reading is told from its channel's offset", "[planner][offset]") {
  const InverseProblem problem = problem_without({});
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
