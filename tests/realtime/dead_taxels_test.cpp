// Taxels left out at run time against plans made without them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/not_finite.hpp"
#include "tests/realtime/plans.hpp"

using namespace tactile_net;

namespace {

struct Case {
  std::string name;
  SensorArray array;
  LineProblemOptions options;
  double alpha = 1e-3;

  [[nodiscard]] EstimatorPlan plan(const std::vector<std::size_t>& dead = {}) const {
    LineProblemOptions with = options;
    with.dead_taxels.insert(with.dead_taxels.end(), dead.begin(), dead.end());
    PlannerOptions planner{.accuracy = 1e-12, .structure = Structure::dense};
    planner.friction_coefficient = 0.5;
    return plan_estimator(make_problem(array, {.youngs_modulus = 1.0, .poisson_ratio = 0.45}, with),
                          alpha, planner)
        .plan;
  }
};

std::vector<Case> cases() {
  using enum Quantity;
  return {
      {"strain", {31, 0.25, {1.5}, {strain_x}}, {.smoothing_length = 1.0}},
      {"shear", {20, 0.5, {1.0}, {shear_xy}}, {.smoothing_length = 1.0}},
      {"two depths, weighted",
       {31, 0.25, {1.0, 2.0}, {stress_x}},
       {.smoothing_length = 1.0, .channel_rms = {2.0, 0.5}}},
      {"weighted, one dead in the plan",
       {31, 0.25, {1.0}, {stress_x, strain_x}},
       {.smoothing_length = 1.0, .channel_rms = {2.0, 0.1}, .dead_taxels = {3}}},
      {"two unknowns",
       {31, 0.25, {1.5}, {stress_x, shear_xy}},
       {.unknowns = 2, .smoothing_length = 1.0}},
  };
}

struct Frame {
  std::vector<double> tractions;
  ContactEstimate estimate;
};
Frame frame(ContactEstimator& estimator, const std::vector<double>& g) {
  Frame result{std::vector<double>(estimator.tractions()), {}};
  result.estimate.tractions = result.tractions;
  REQUIRE(estimator.update(g, result.estimate) == FrameStatus::ok);
  return result;
}

void check_equal(const Frame& a, const Frame& b, double tolerance) {
  CHECK(l2_difference(a.tractions, b.tractions) <= tolerance);
  const double size = l2_norm(b.tractions);
  CHECK_THAT(a.estimate.normal_force, WithinAbs(b.estimate.normal_force, tolerance * 10.0 * size));
  CHECK_THAT(a.estimate.residual_rms, WithinRel(b.estimate.residual_rms, 100.0 * tolerance));
  CHECK(a.estimate.outlier == b.estimate.outlier);
  CHECK(a.estimate.saturated == b.estimate.saturated);
}

}  // namespace

TEST_CASE("taxels left out at run time: the answer of a plan made without them", "[dead_taxels]") {
  const auto all = cases();
  const Case& one = all.at(GENERATE(range(std::size_t{0}, std::size_t{5})));
  const std::vector<std::size_t> dead =
      GENERATE(std::vector<std::size_t>{10}, std::vector<std::size_t>{0},
               std::vector<std::size_t>{5, 12, 19}, std::vector<std::size_t>{11, 9, 10});
  CAPTURE(one.name, dead);
  ContactEstimator without(one.plan(dead));
  ContactEstimator estimator(one.plan());
  for (const std::size_t taxel : dead) REQUIRE(estimator.set_dead(taxel));
  int outliers = 0;
  for (unsigned seed = 0; seed < 5; ++seed) {
    std::vector<double> g = random_values(estimator.readings(), seed);
    if (seed > 1)
      g[one.array.count / 2 + 3] += std::pow(20.0, seed);  // from no outlier to a clear one
    for (std::size_t i = 0; i < g.size(); ++i)
      if (std::count(dead.begin(), dead.end(), i % one.array.count) > 0)
        g[i] = seed % 2 == 0 ? not_a_number : -std::numeric_limits<double>::infinity();
    const Frame expected = frame(without, g);
    check_equal(frame(estimator, g), expected, 1e-9);
    outliers += expected.estimate.outlier >= 0;
  }
  CHECK(outliers > 0);
}

TEST_CASE("the order of deaths does not matter, and the living are as before after revival",
          "[dead_taxels]") {
  const auto all = cases();
  const Case& one = all.at(GENERATE(range(std::size_t{0}, std::size_t{5})));
  CAPTURE(one.name);
  ContactEstimator estimator(one.plan());
  const std::vector<double> g = random_values(estimator.readings(), 3);
  const Frame before = frame(estimator, g);
  std::vector<std::size_t> dead{4, 15, 5, 16};
  std::vector<Frame> answers;
  do {
    for (const std::size_t taxel : dead) REQUIRE(estimator.set_dead(taxel));
    for (const std::size_t taxel : dead) REQUIRE(estimator.set_dead(taxel));  // dead is dead
    answers.push_back(frame(estimator, g));
    estimator.revive();
    const Frame revived = frame(estimator, g);
    CHECK(revived.tractions == before.tractions);
    CHECK(revived.estimate.residual_rms == before.estimate.residual_rms);
  } while (std::next_permutation(dead.begin(), dead.end()));
  for (const Frame& answer : answers) check_equal(answer, answers.front(), 1e-11);
  CHECK(l2_difference(answers.front().tractions, before.tractions) > 1e-3);
}

TEST_CASE("a dead taxel in float32 and in every structure, as accurate as the plan",
          "[dead_taxels]") {
  const auto all = cases();
  const Case& one = all.at(GENERATE(range(std::size_t{0}, std::size_t{5})));
  const LinearProblem problem =
      make_problem(one.array, {.youngs_modulus = 1.0, .poisson_ratio = 0.45}, one.options);
  ContactEstimator without(one.plan({12}));
  for (const Structure structure :
       {Structure::low_rank, Structure::reflections, Structure::reflections_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      if (!one.options.dead_taxels.empty() && has_reflections(structure)) continue;
      CAPTURE(one.name, name(structure), name(precision));
      PlannerOptions options{.accuracy = 1e-7, .structure = structure};
      options.precision = precision;
      ContactEstimator estimator(plan_estimator(problem, one.alpha, options).plan);
      REQUIRE(estimator.set_dead(12));
      const std::vector<double> g = random_values(estimator.readings(), 1);
      const Frame expected = frame(without, g);
      CHECK(l2_difference(frame(estimator, g).tractions, expected.tractions) <=
            (precision == Precision::float64 ? 1e-4 : 1e-3));
    }
}

TEST_CASE("what set_dead refuses leaves everything as it was, to the bit", "[dead_taxels]") {
  using enum Quantity;
  // Far apart, one channel precise, one coarse: the coarse reading of a taxel is predicted by the
  // precise one, which then nothing predicts.
  const Case sparse{"sparse",
                    {9, 4.0, {1.0, 1.1}, {stress_x}},
                    {.smoothing_length = 1.0, .channel_rms = {10.0, 1.0}},
                    1e-6};
  ContactEstimator estimator(sparse.plan());
  REQUIRE(estimator.readings() == 18);
  const std::vector<double> g = random_values(18, 2);
  const Frame before = frame(estimator, g);
  const auto unchanged = [&](const Frame& expected) {
    const Frame now = frame(estimator, g);
    CHECK(now.tractions == expected.tractions);
    CHECK(now.estimate.residual_rms == expected.estimate.residual_rms);
    CHECK(now.estimate.outlier == expected.estimate.outlier);
  };
  for (std::size_t taxel = 0; taxel < 9; ++taxel) CHECK_FALSE(estimator.set_dead(taxel));
  CHECK_FALSE(estimator.set_dead(9));
  CHECK_FALSE(estimator.set_dead(std::numeric_limits<std::size_t>::max()));
  unchanged(before);
  // Nor does it stop counting: its reading matters still.
  std::vector<double> bad = g;
  bad[13] = not_a_number;
  Frame kept = before;
  kept.estimate.tractions = kept.tractions;
  CHECK(estimator.update(bad, kept.estimate) == FrameStatus::not_finite);

  // At most so many; a refusal after others keeps those.
  ContactEstimator crowded(made_plan({.count = 21}));
  const std::vector<double> h = random_values(21, 2);
  for (std::size_t taxel = 0; taxel < ContactEstimator::most_dead_taxels; ++taxel)
    REQUIRE(crowded.set_dead(2 * taxel));
  const Frame eight = frame(crowded, h);
  CHECK_FALSE(crowded.set_dead(1));
  CHECK(frame(crowded, h).tractions == eight.tractions);
  CHECK(frame(crowded, h).estimate.residual_rms == eight.estimate.residual_rms);
  crowded.revive();
  CHECK(crowded.set_dead(1));

  ContactEstimator blind(made_plan({.diagnostics = false}));
  CHECK_FALSE(blind.set_dead(1));
  blind.revive();

  // The last one lives.
  ContactEstimator pair(made_plan({.count = 2}));
  CHECK(pair.set_dead(0));
  CHECK_FALSE(pair.set_dead(1));
}

TEST_CASE("taxels of very many readings die until there is no more room for them",
          "[dead_taxels]") {
  // Room is made for what the plan's size allows, not for its square.
  const std::size_t channels = ContactEstimator::most_dead_readings / 2 + 1;
  ContactEstimator estimator(
      made_plan({.count = 3, .channels = channels, .structure = Structure::low_rank}));
  const std::vector<double> g = random_values(estimator.readings(), 4);
  REQUIRE(estimator.set_dead(0));
  const Frame one = frame(estimator, g);
  CHECK_FALSE(estimator.set_dead(1));
  CHECK(frame(estimator, g).tractions == one.tractions);
  estimator.revive();
  CHECK(estimator.set_dead(1));
}

TEST_CASE("taxels that the plan leaves out may read anything", "[dead_taxels]") {
  const auto all = cases();
  const Case& one = all.at(3);
  ContactEstimator estimator(one.plan());
  std::vector<double> g = random_values(estimator.readings(), 1);
  const Frame expected = frame(estimator, g);
  for (const double reading : {not_a_number, 1e308, -1.0}) {
    g[3] = g[3 + one.array.count] = reading;
    const Frame result = frame(estimator, g);
    CHECK(result.tractions == expected.tractions);
    CHECK(result.estimate.residual_rms == expected.estimate.residual_rms);
  }
  CHECK(estimator.set_dead(3));  // as it is
  CHECK(frame(estimator, g).tractions == expected.tractions);
}
