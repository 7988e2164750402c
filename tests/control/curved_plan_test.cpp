// What a controller's frame says of a curved skin in the sensor's own axes.
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tactile_net/skin/resultant.hpp"
#include "tactile_net/skin/space_wrench.hpp"
#include "tests/catch.hpp"
#include "tests/realtime/batches.hpp"

using namespace tactile_net;

namespace {

constexpr double noise = 1e-8;  // [m]
const SpaceVector about{2e-3, -7e-3, 5e-3};

/// Taxels below a ball of 20 mm, which move.
LinearProblem ball_problem() {
  constexpr double radius = 20e-3;
  constexpr double depth = 1.2e-3;
  std::vector<CurvedTaxel> taxels;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double x = 2e-3 * (i - 2.5);
      const double y = 2e-3 * (j - 2.5);
      const SpaceVector normal =
          multiple(1.0 / radius, {x, y, std::sqrt(radius * radius - x * x - y * y)});
      taxels.push_back(
          {"t" + std::to_string(i) + "_" + std::to_string(j),
           multiple(radius - depth, normal),
           normal,
           depth,
           {Quantity::displacement_x, Quantity::displacement_y, Quantity::displacement_z}});
    }
  const Material pad{
      .youngs_modulus = 2.5e5, .poisson_ratio = 0.48, .layer = Layer{4e-3, Base::bonded}};
  return make_problem(curved_skin(taxels, {.shape = SurfaceShape::sphere}), pad,
                      {.smoothing_length = 2e-3, .grid = {.spacing = 1.5e-3}});
}

/// What the skin reads of a smooth press with a drag, at a place off its middle.
std::vector<double> press_on(const LinearProblem& problem) {
  const std::size_t count = problem.grid.count();
  std::vector<double> f(problem.components * count);
  for (std::size_t cell = 0; cell < count; ++cell) {
    const double y = problem.grid.y(cell / problem.grid.columns) - 1e-3;
    const double z = problem.grid.z(cell % problem.grid.columns) + 2e-3;
    const double press = std::max(0.0, 1.0 - (y * y + z * z) / 9e-6);
    f[cell] = 8e3 * press;
    f[count + cell] = 2e3 * press;
    f[2 * count + cell] = -1e3 * press;
  }
  std::vector<double> readings(problem.kernel.rows);
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i] = std::inner_product(
        f.begin(), f.end(),
        problem.kernel.values.begin() + static_cast<std::ptrdiff_t>(i * f.size()), 0.0);
  return readings;
}

/// A hundredth of what the largest singular value can be, squared.
double alpha_of(const LinearProblem& problem) {
  const std::vector<double>& values = problem.kernel.values;
  return 1e-4 * std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

struct Frame {
  std::vector<double> tractions;
  ContactEstimate estimate;
};

Frame frame_of(const EstimatorPlan& plan, const std::vector<double>& readings) {
  ContactEstimator estimator(plan);
  Frame frame{.tractions = std::vector<double>(estimator.tractions()), .estimate = {}};
  frame.estimate.tractions = frame.tractions;
  REQUIRE(estimator.update(readings, frame.estimate) == FrameStatus::ok);
  return frame;
}

void check_near(const std::array<double, 3>& found, const std::array<double, 3>& expected,
                double error) {
  CAPTURE(found, expected);
  for (std::size_t k = 0; k < 3; ++k) CHECK_THAT(found[k], WithinAbs(expected[k], error));
}

}  // namespace

TEST_CASE("a frame's force, moment and centre in space are those of the desk", "[curved_plan]") {
  const LinearProblem problem = ball_problem();
  const double alpha = alpha_of(problem);
  const std::vector<double> readings = press_on(problem);
  const PlannedEstimator one = plan_estimator(problem, alpha, {.moment_about = about});
  const Frame frame = frame_of(one.plan, readings);

  const TikhonovFamily family(problem);
  const TractionCovariance covariance(family, alpha, alpha);
  std::vector<std::size_t> cells(problem.grid.count());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  const UncertainWrench chart =
      resultant_of(problem.grid, frame.tractions, cells, covariance, noise);
  const SpaceWrench wrench =
      space_wrench(problem, frame.tractions, cells, covariance, noise, chart, about);
  const auto values = [](const std::array<Uncertain, 3>& vector) {
    return std::array{vector[0].value, vector[1].value, vector[2].value};
  };
  const SpaceEstimate& space = frame.estimate.space;
  const double force = length(space.force);
  CHECK(force > 0.05);
  check_near(space.force, values(wrench.force), 1e-12 * force);
  check_near(space.moment, values(wrench.moment), 1e-14 * force);
  REQUIRE(wrench.centre);
  check_near(space.centre, values(*wrench.centre), 1e-14);

  // Another point: the moment differs by the arm.
  const Frame origin = frame_of(plan_estimator(problem, alpha).plan, readings);
  check_near(origin.estimate.space.force, space.force, 1e-12 * force);
  check_near(origin.estimate.space.moment,
             combined(1.0, space.moment, 1.0, cross(about, space.force)), 1e-14 * force);
}

TEST_CASE("cells that touch are summed in space too, and without contact there is no centre",
          "[curved_plan]") {
  const LinearProblem problem = ball_problem();
  const double alpha = alpha_of(problem);
  const std::vector<double> readings = press_on(problem);
  const PlannedEstimator all = plan_estimator(problem, alpha, {.moment_about = about});
  const PlannedEstimator some =
      plan_estimator(problem, alpha, {.noise_rms = noise, .moment_about = about});
  const Frame frame = frame_of(some.plan, readings);
  CHECK(frame.estimate.touching > 4);
  CHECK(frame.estimate.touching < problem.grid.count());
  const std::array<double, 3> whole = frame_of(all.plan, readings).estimate.space.force;
  const std::array<double, 3>& part = frame.estimate.space.force;
  CHECK(length(combined(1.0, whole, -1.0, part)) < 0.1 * length(whole));
  CHECK(length(combined(1.0, whole, -1.0, part)) > 0.0);

  // Along a place's own axes the pressed force is larger than what is left of it in space.
  CHECK(length(part) <=
        std::hypot(frame.estimate.normal_force, frame.estimate.tangential_force) * (1.0 + 1e-12));

  const Frame still = frame_of(all.plan, std::vector<double>(readings.size(), 0.0));
  CHECK_FALSE(still.estimate.contact);
  CHECK(length(still.estimate.space.force) == 0.0);
  CHECK(std::isnan(still.estimate.space.centre[0]));
}

TEST_CASE("constraints and batches keep a curved skin's sums", "[curved_plan]") {
  const LinearProblem problem = ball_problem();
  const double alpha = alpha_of(problem);
  std::vector<double> readings = press_on(problem);
  PlannerOptions options{.noise_rms = noise, .friction_coefficient = 0.8, .moment_about = about};
  const Frame free = frame_of(plan_estimator(problem, alpha, options).plan, readings);
  options.cone = ConeOptions{.constraints = {.friction_limit = 0.8}};
  const PlannedEstimator one = plan_estimator(problem, alpha, options);
  const Frame frame = frame_of(one.plan, readings);
  CHECK(length(combined(1.0, frame.estimate.space.force, -1.0, free.estimate.space.force)) <
        0.1 * length(free.estimate.space.force));

  const std::vector<double> first = readings;
  for (const double scale : {0.5, 0.0, -1.0})
    for (const double reading : first) readings.push_back(scale * reading);
  ContactEstimator estimator(one.plan);
  check_batch(estimator, readings);
}

TEST_CASE("a file keeps a curved skin's plan, and refuses sizes that do not fit", "[curved_plan]") {
  const LinearProblem problem = ball_problem();
  const double alpha = alpha_of(problem);
  const std::vector<double> readings = press_on(problem);
  PlannerOptions options{.noise_rms = noise, .moment_about = about};
  for (const bool constrained : {false, true}) {
    if (constrained) options.cone = ConeOptions{.constraints = {.nonnegative = true}};
    const PlannedEstimator one = plan_estimator(problem, alpha, options);
    const std::vector<std::byte> bytes = encode_plan(one.plan);
    CHECK(bytes[8] == static_cast<std::byte>(PlanVersion::space));
    const EstimatorPlan again = decode_plan(bytes);
    CHECK(encode_plan(again) == bytes);
    CHECK(same_bits(numbers_of(frame_of(again, readings).estimate),
                    numbers_of(frame_of(one.plan, readings).estimate)));

    EstimatorPlan wrong = one.plan;
    wrong.space->wrench.pop_back();
    CHECK_THROWS_WITH(check(wrong), ContainsSubstring("six numbers"));
    wrong = one.plan;
    wrong.space->places.back() = std::nan("");
    CHECK_THROWS_WITH(encode_plan(wrong), ContainsSubstring("finite"));
  }
  CHECK_THROWS_WITH(plan_estimator(problem, alpha, {.moment_about = {0.0, INFINITY, 0.0}}),
                    ContainsSubstring("moment_about"));
}
