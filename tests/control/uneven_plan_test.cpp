// Plans of arrays whose taxels do not all read the same.
#include <vector>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tests/catch.hpp"
#include "tests/control/frames.hpp"

using namespace tactile_net;

namespace {

const Material silicone{.youngs_modulus = 2e5, .poisson_ratio = 0.45};

SensorArray strip() {
  std::vector<Taxel> taxels;
  for (int i = 0; i < 9; ++i) {
    Taxel taxel{.y = 1e-3 * (2.0 * i + 0.05 * i * i), .depth = 1.5e-3};
    if (i % 3 != 1) taxel.reads.push_back(Quantity::stress_x);
    if (i % 3 != 2) taxel.reads.push_back(Quantity::shear_xy);
    taxels.push_back(std::move(taxel));
  }
  return uneven_array(std::move(taxels));
}

LinearProblem problem_of(std::vector<std::size_t> dead = {}) {
  return make_problem(strip(), silicone,
                      {.unknowns = 2,
                       .smoothing_length = 1.5e-3,
                       .dead_taxels = std::move(dead),
                       .surface = {.basis = SurfaceBasis::hats}});
}

}  // namespace

TEST_CASE("a plan of an uneven array answers as the problem does, before and after its file",
          "[planner][uneven]") {
  const LinearProblem problem = problem_of();
  const PlannedEstimator planned = plan_estimator(problem, 1e-3, {.accuracy = 1e-9});
  CHECK(planned.plan.taxels.size() == problem.sites.size());
  const EstimatorPlan read = decode_plan(encode_plan(planned.plan));
  CHECK(read.taxels == planned.plan.taxels);
  const Reconstruction dense = tikhonov(problem, 1e-3);
  ContactEstimator estimator(read);
  std::vector<double> f(dense.tractions());
  std::vector<double> expected(f.size());
  ContactEstimate estimate{.tractions = f};
  const std::vector<double> g = random_values(dense.readings(), 3);
  REQUIRE(dense.solve(g, expected) == FrameStatus::ok);
  REQUIRE(estimator.update(g, estimate) == FrameStatus::ok);
  CHECK(l2_norm(difference(f, expected)) < 1e-7 * l2_norm(expected));
}

TEST_CASE("a taxel that dies at run time takes its own readings with it", "[planner][uneven]") {
  const PlannedEstimator planned = plan_estimator(problem_of(), 1e-3, {.accuracy = 1e-11});
  for (std::size_t taxel = 0; taxel < 9; ++taxel) {
    CAPTURE(taxel);
    const Reconstruction without = tikhonov(problem_of({taxel}), 1e-3);
    ContactEstimator estimator(planned.plan);
    REQUIRE(estimator.set_dead(taxel));
    std::vector<double> f(without.tractions());
    std::vector<double> expected(f.size());
    ContactEstimate estimate{.tractions = f};
    const std::vector<double> g = random_values(without.readings(), 7);
    REQUIRE(without.solve(g, expected) == FrameStatus::ok);
    REQUIRE(estimator.update(g, estimate) == FrameStatus::ok);
    CHECK(l2_norm(difference(f, expected)) < 1e-7 * l2_norm(expected));
  }
  ContactEstimator estimator(planned.plan);
  CHECK_FALSE(estimator.set_dead(9));
}

TEST_CASE("a range may be of each reading", "[planner][uneven]") {
  const LinearProblem problem = problem_of();
  PlannerOptions options;
  options.ranges.assign(problem.sites.size(), {-1.0, 1.0});
  options.ranges[4] = {-1.0, 0.1};
  ContactEstimator estimator(plan_estimator(problem, 1e-3, options).plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  std::vector<double> g(problem.sites.size(), 0.2);
  REQUIRE(estimator.update(g, estimate) == FrameStatus::ok);
  CHECK(estimate.saturated);
  g[4] = 0.0;
  REQUIRE(estimator.update(g, estimate) == FrameStatus::ok);
  CHECK_FALSE(estimate.saturated);
  options.ranges.resize(2, {-1.0, 1.0});  // channels differ in length: which is whose?
  CHECK_THROWS_AS(plan_estimator(problem, 1e-3, options), std::invalid_argument);
}

TEST_CASE("a plan whose taxels are not there is refused", "[planner][uneven]") {
  EstimatorPlan plan = plan_estimator(problem_of(), 1e-3).plan;
  plan.taxels[3] = 9;
  CHECK_THROWS_WITH(check(plan), ContainsSubstring("taxels must be < count"));
}
