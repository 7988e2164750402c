// Which readings are called outliers, and above all which are not.
#include <algorithm>
#include <cmath>
#include <random>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/realtime/plans.hpp"

using namespace tactile_net;

namespace {

const Material material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};

struct Sensor {
  std::string name;
  SensorArray array;
  std::size_t unknowns = 1;

  [[nodiscard]] LinearProblem problem() const {
    return make_problem(array, material,
                        {.unknowns = unknowns, .smoothing_length = array.depths.front()});
  }
};

std::vector<Sensor> sensors() {
  using enum Quantity;
  return {{"strain", {41, 0.25, {1.5}, {strain_x}}},
          {"strain, shallow", {41, 0.25, {0.75}, {strain_x}}},
          {"shear", {41, 0.25, {1.5}, {shear_xy}}},
          {"two depths", {41, 0.25, {1.0, 1.5}, {stress_x}}},
          {"two unknowns", {41, 0.25, {1.5}, {stress_x, shear_xy}}, 2}};
}

/// Exact readings of the library's shapes, from the middle to beyond the end of the array.
std::vector<std::vector<double>> contacts(const Sensor& sensor) {
  const double length = static_cast<double>(sensor.array.count) * sensor.array.pitch;
  std::vector<std::vector<double>> all;
  for (const Shape shape : {Shape::cylinder, Shape::punch, Shape::wedge})
    for (const double centre : {0.0, 0.02, 0.3, 0.44, 0.48, 0.5, 0.52, 0.56, -0.5})
      for (const double half_width : {0.3, 1.0, 2.0}) {
        const Contact contact = RigidContact{.shape = shape,
                                             .center = centre * length,
                                             .half_width = half_width,
                                             .friction = sensor.unknowns == 2 ? 0.4 : 0.0};
        all.push_back(exact_readings(sensor.array, material, std::span(&contact, 1)));
      }
  return all;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

std::ptrdiff_t outlier(ContactEstimator& estimator, const std::vector<double>& g) {
  std::vector<double> tractions(estimator.tractions());
  ContactEstimate estimate{.tractions = tractions};
  REQUIRE(estimator.update(g, estimate) == FrameStatus::ok);
  return estimate.outlier;
}

void add_noise(std::vector<double>& g, double rms, std::mt19937& generator) {
  std::normal_distribution<double> noise(0.0, rms);
  for (double& value : g) value += noise(generator);
}

}  // namespace

TEST_CASE("contacts are no outliers: every shape, with and without noise, up to the array's end",
          "[outlier]") {
  const auto all = sensors();
  const Sensor& sensor = all.at(GENERATE(range(std::size_t{0}, std::size_t{5})));
  const double alpha = GENERATE(1e-2, 1e-4, 1e-6, 1e-8);
  CAPTURE(sensor.name, alpha);
  const LinearProblem problem = sensor.problem();
  std::mt19937 generator(1);
  for (const double accuracy : {1e-3, 1e-7}) {
    ContactEstimator estimator(plan_estimator(problem, alpha, {.accuracy = accuracy}).plan);
    int flagged = 0;
    for (std::vector<double> g : contacts(sensor)) {
      flagged += outlier(estimator, g) >= 0;
      add_noise(g, 0.003 * largest(g), generator);
      flagged += outlier(estimator, g) >= 0;
    }
    CHECK(flagged == 0);
  }
}

TEST_CASE("white noise alone is called an outlier less than once in a thousand frames",
          "[outlier]") {
  const auto all = sensors();
  const Sensor& sensor = all.at(GENERATE(range(std::size_t{0}, std::size_t{5})));
  CAPTURE(sensor.name);
  std::mt19937 generator(2);
  for (const double alpha : {1e-2, 1e-6}) {
    PlannerOptions options;
    SECTION("noise not known") {}
    SECTION("noise known") { options.noise_rms = 1.0; }
    ContactEstimator estimator(plan_estimator(sensor.problem(), alpha, options).plan);
    int flagged = 0;
    for (int k = 0; k < 2000; ++k) {
      std::vector<double> g(estimator.readings());
      add_noise(g, 1.0, generator);
      flagged += outlier(estimator, g) >= 0;
    }
    CHECK(flagged <= 2);
  }
}

TEST_CASE("a faulty reading is named: shifted, stuck or alone, in contact with noise",
          "[outlier]") {
  const auto all = sensors();
  const Sensor& sensor = all.at(GENERATE(range(std::size_t{0}, std::size_t{5})));
  CAPTURE(sensor.name);
  const LinearProblem problem = sensor.problem();
  const std::size_t count = problem.grid.count();
  std::mt19937 generator(3);
  const Contact contact = RigidContact{.center = 0.3, .half_width = 2.0};
  const std::vector<double> clean = exact_readings(sensor.array, material, std::span(&contact, 1));
  std::vector<double> noisy = clean;
  add_noise(noisy, 0.003 * largest(clean), generator);
  // alpha as a controller's plan has it: by the rule, on a recorded frame.
  const TikhonovFamily family(problem);
  const double alpha = choose_alpha(family.analyse(noisy), AlphaRule::rgcv).alpha;
  ContactEstimator estimator(plan_estimator(problem, alpha).plan);
  REQUIRE(outlier(estimator, noisy) == -1);

  int frames = 0;
  int named = 0;
  int wrong = 0;
  const auto judge = [&](const std::vector<double>& g, std::size_t at) {
    const std::ptrdiff_t found = outlier(estimator, g);
    ++frames;
    named += found == static_cast<std::ptrdiff_t>(at);
    wrong += found >= 0 && found != static_cast<std::ptrdiff_t>(at);
  };
  for (std::size_t at = 0; at < noisy.size(); ++at) {
    const std::size_t taxel = at % count;
    if (taxel < ContactEstimator::unjudged_ends || taxel + ContactEstimator::unjudged_ends >= count)
      continue;
    std::vector<double> g = noisy;
    g[at] += 0.3 * largest(clean);
    judge(g, at);
    g[at] -= 0.6 * largest(clean);
    judge(g, at);
    std::vector<double> alone(g.size(), 0.0);  // no contact, one reading off
    alone[at] = largest(clean);
    judge(alone, at);
    if (std::abs(noisy[at]) < 0.3 * largest(clean)) continue;
    g = noisy;
    g[at] = 0.0;  // stuck
    judge(g, at);
  }
  CHECK(named == frames);
  CHECK(wrong == 0);
}

TEST_CASE("faults at the very end are never named, nor is anyone blamed for them", "[outlier]") {
  const Sensor sensor = sensors().front();
  ContactEstimator estimator(plan_estimator(sensor.problem(), 1e-6).plan);
  for (const std::size_t at : {0U, 1U, 2U, 38U, 39U, 40U}) {
    std::vector<double> g = contacts(sensor).front();
    g[at] += 0.1 * largest(g);
    CAPTURE(at);
    CHECK(outlier(estimator, g) == -1);
  }
}

TEST_CASE("a known noise is a floor: what lies within it is not an outlier", "[outlier]") {
  EstimatorPlan plan = made_plan({.count = 21});
  std::vector<double> g(21, 0.0);
  g[9] = 1.0;
  ContactEstimator unknown(plan);
  CHECK(outlier(unknown, g) == 9);
  // The deleted residual is 1 with deviation noise / sqrt(1 - h): the limit lies at 6 of those.
  const double limit = std::sqrt(1.0 - plan.leverages[9]) / plan.outlier_limit;
  plan.noise_rms = 0.99 * limit;
  ContactEstimator quiet(plan);
  CHECK(outlier(quiet, g) == 9);
  plan.noise_rms = 1.01 * limit;
  ContactEstimator loud(plan);
  CHECK(outlier(loud, g) == -1);
}

TEST_CASE("a dead taxel is not named, and one fault left out shows the other", "[outlier]") {
  ContactEstimator estimator(made_plan({.count = 21}));
  std::vector<double> g(21, 0.0);
  g[9] = 10.0;
  g[14] = -9.0;
  CHECK(outlier(estimator, g) == -1);  // each hides the other
  g[9] = 1000.0;
  CHECK(outlier(estimator, g) == 9);
  REQUIRE(estimator.set_dead(9));
  CHECK(outlier(estimator, g) == 14);
  REQUIRE(estimator.set_dead(14));
  CHECK(outlier(estimator, g) == -1);
}

TEST_CASE("what the others cannot predict is not judged", "[outlier]") {
  EstimatorPlan plan = made_plan({.count = 21});
  plan.leverages[9] = 1.0 - 0.9 * ContactEstimator::least_pivot;
  ContactEstimator estimator(plan);
  std::vector<double> g(21, 0.0);
  g[9] = 1.0;
  CHECK(outlier(estimator, g) == -1);
}

TEST_CASE("what the plan's own accuracy explains is not an outlier", "[outlier]") {
  const Sensor sensor = sensors().front();
  const std::vector<double> g = contacts(sensor).front();
  PlannerOptions options{.accuracy = 1e-12, .structure = Structure::dense};
  EstimatorPlan plan = plan_estimator(sensor.problem(), 1e-10, options).plan;
  // A prediction that is wrong for one reading, by as much as an accuracy of 1e-4 allows.
  const double size = l2_norm(g);
  REQUIRE(plan.prediction->structure == Structure::reflections);
  const EstimatorPlan whole = [&] {
    EstimatorPlan dense = plan;
    ProductPlan& prediction = *dense.prediction;
    const std::size_t n = g.size();
    Factor factor{n, n, std::vector<double>(n * n)};
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<double> unit(n, 0.0);
      unit[j] = 1.0;
      const std::vector<double> column = by_definition(*plan.prediction, unit);
      for (std::size_t i = 0; i < n; ++i) factor.values[i * n + j] = column[i];
    }
    for (std::size_t j = 0; j < n; ++j) factor.values[17 * n + j] += 0.9e-4 * g[j] / size;
    prediction.structure = Structure::dense;
    prediction.row_grid = prediction.column_grid = {};
    prediction.factors = {factor};
    prediction.scale = 1.0;
    return dense;
  }();
  ContactEstimator trusting(whole);
  CHECK(outlier(trusting, g) == 17);
  EstimatorPlan coarse = whole;
  coarse.accuracy = 1e-4;
  ContactEstimator knowing(coarse);
  CHECK(outlier(knowing, g) == -1);
}
