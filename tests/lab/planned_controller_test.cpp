#include "tactile_net/lab/planned_controller.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

SceneProblem line_problem(const std::string& rest) {
  return SceneProblem(
      parse_scene("[sensor]\ncount = 21\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
                  "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n" +
                      rest,
                  "scene.toml"));
}

const std::string cylinder_contact =
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.5\nforce = 1.0\n[noise]\nrms = 1e-3\n";

/// The scene's frame three times, 1, 10 and 0.1 times as large.
NextFrame recording(const SceneProblem& problem) {
  return [readings = simulate(problem.scene()).readings, k = 0](std::span<double> out) mutable {
    if (k == 3) return false;
    const double scales[] = {1.0, 10.0, 0.1};
    std::transform(readings.begin(), readings.end(), out.begin(),
                   [&](double g) { return scales[k] * g; });
    ++k;
    return true;
  };
}

}  // namespace

TEST_CASE("a controller's alpha is given, its contact's, or the median of a recording's",
          "[lab][controller]") {
  const SceneProblem given = line_problem(cylinder_contact + "[reconstruct]\nalpha = 1e-4\n");
  const auto alpha = plan_alpha(given, [](std::span<double>) -> bool {
    FAIL("a given alpha asks for no frame");
    return false;
  });
  REQUIRE(alpha);
  CHECK(alpha->value == 1e-4);
  CHECK(alpha->source == PlanAlpha::Source::given);
  CHECK_FALSE(alpha->rule);

  const SceneProblem ruled = line_problem(cylinder_contact);
  const auto of_contact = plan_alpha(ruled);
  REQUIRE(of_contact);
  CHECK(of_contact->source == PlanAlpha::Source::contact);
  CHECK(of_contact->rule == AlphaRule::aicc);  // of dense arrays
  CHECK(of_contact->value == SceneFrame(ruled, simulate(ruled.scene()).readings).alpha().value);

  const auto of_frames = plan_alpha(ruled, recording(ruled));
  REQUIRE(of_frames);
  CHECK(of_frames->source == PlanAlpha::Source::recording);
  CHECK(of_frames->frames == 3);
  std::vector<double> each;
  std::vector<double> readings(ruled.readings());
  for (auto next = recording(ruled); next(readings);)
    each.push_back(SceneFrame(ruled, readings).alpha().value);
  std::sort(each.begin(), each.end());
  CHECK(of_frames->value == each[1]);
}

TEST_CASE("without a frame a rule has nothing to choose an alpha by", "[lab][controller]") {
  CHECK_FALSE(plan_alpha(line_problem("")));
  CHECK_FALSE(plan_alpha(line_problem(cylinder_contact), [](std::span<double>) { return false; }));
}

TEST_CASE("the scene fills in what a controller's options leave open", "[lab][controller]") {
  const SceneProblem problem = line_problem(
      "[noise]\nrms = 0.02\n[quantization]\nbits = 12\nrange = [-2.0, 3.0]\n"
      "[reconstruct]\nalpha = 1e-3\n");
  const PlanAlpha alpha{.value = 1e-3};
  const EstimatorPlan plan =
      plan_controller(problem, alpha, {.friction_coefficient = 0.7}).estimator.plan;
  CHECK(plan.alpha == 1e-3);
  CHECK(plan.label == "scene.toml");
  CHECK(plan.friction_coefficient == 0.7);
  REQUIRE(plan.ranges.size() == 1);
  CHECK(plan.ranges[0].lowest == -2.0);
  CHECK(plan.ranges[0].highest == 3.0);
  CHECK(plan.readings() == problem.readings());
}

TEST_CASE("a plan's force beside the solver's: the same, but for constraints",
          "[lab][controller]") {
  const auto force_of = [](const std::string& reconstruct, bool raw = false) {
    const SceneProblem problem =
        line_problem(cylinder_contact + "[reconstruct]\nalpha = 1e-4\n" + reconstruct +
                     (raw ? "[calibration]\ngain = 0.25\noffset = 0.5\n" : ""));
    const PlannedController planned = plan_controller(problem, *plan_alpha(problem));
    CHECK(planned.estimator.plan.border == std::vector<std::uint32_t>{0, 20});
    return planned_force(problem, planned.estimator.plan).value();
  };
  const PlannedForce free = force_of("");
  CHECK_THAT(free.planned, WithinRel(free.solved, 1e-6));
  CHECK_THAT(force_of("", true).planned, WithinRel(free.solved, 1e-6));
  const PlannedForce bound = force_of("nonnegative = true\n");
  CHECK_THAT(bound.planned, WithinRel(free.planned, 1e-6));
  CHECK(std::abs(bound.solved - bound.planned) > 1e-4 * bound.solved);
  const SceneProblem empty = line_problem("[reconstruct]\nalpha = 1e-4\n");
  CHECK_FALSE(planned_force(empty, plan_controller(empty, *plan_alpha(empty)).estimator.plan));
}

}  // namespace tactile_net::lab
