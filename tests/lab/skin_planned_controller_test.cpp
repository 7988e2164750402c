// Plans of skins from their scenes.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const std::string sphere_contact =
    "[[contact]]\nshape = \"sphere\"\nplace = [0.3, -0.2]\nradius = 1.5\nforce = 1.0\n"
    "friction = 0.4\ndirection = 30.0\n";

lab::SkinSceneProblem skin_problem(const std::string& more) {
  const std::string toml =
      "title = \"a small skin\"\n[sensor]\nrows = 7\ncolumns = 7\npitch = 1.0\ndepth = 1.0\n"
      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n[noise]\nrms = 1e-4\n";
  return lab::SkinSceneProblem(std::get<SkinScene>(parse_any_scene(toml + more, "skin.toml")));
}

}  // namespace

TEST_CASE("a skin's plan takes the scene's alpha, or its rule's", "[lab][skin]") {
  const auto given = lab::plan_alpha(skin_problem("[reconstruct]\nalpha = 1e-3\n"));
  REQUIRE(given);
  CHECK(given->value == 1e-3);
  CHECK(given->source == lab::PlanAlpha::Source::given);

  const lab::SkinSceneProblem ruled = skin_problem(sphere_contact);
  const auto of_contact = lab::plan_alpha(ruled);
  REQUIRE(of_contact);
  CHECK(of_contact->source == lab::PlanAlpha::Source::contact);
  const std::vector<double> readings = lab::simulate(ruled.scene()).readings;
  CHECK(of_contact->value == solve(ruled, readings).alpha.value);

  int frames = 0;
  const auto of_frames = lab::plan_alpha(ruled, [&](std::span<double> frame) {
    std::copy(readings.begin(), readings.end(), frame.begin());
    return frames++ < 3;
  });
  REQUIRE(of_frames);
  CHECK(of_frames->frames == 3);
  CHECK(of_frames->value == of_contact->value);
  CHECK_FALSE(lab::plan_alpha(skin_problem("")));
}

TEST_CASE("a controller of a skin finds what `solve` finds, dead taxels or not", "[lab][skin]") {
  for (const std::string dead : {"", "[dead_taxels]\nindices = [0, 25]\n"}) {
    const lab::SkinSceneProblem problem = skin_problem(sphere_contact + dead);
    const auto alpha = lab::plan_alpha(problem);
    const lab::PlannedController planned =
        lab::plan_controller(problem, *alpha, {.friction_coefficient = 0.5});
    const EstimatorPlan& plan = planned.estimator.plan;
    CHECK(plan.label == "a small skin");
    CHECK(plan.fill.has_value() == !dead.empty());
    CHECK(plan.reconstruction.structure == Structure::reflections);
    CHECK(plan.noise_rms == 1e-4);
    CHECK(plan.traction_limit == 1.0);
    ContactEstimator estimator(plan);
    std::vector<double> f(estimator.tractions());
    ContactEstimate estimate{.tractions = f};
    const std::vector<double> readings = lab::simulate(problem.scene()).readings;
    REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
    const lab::FrameAnswer answer = solve(problem, readings);
    double apart = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      apart = std::hypot(apart, f[i] - answer.tractions[i]);
      size = std::hypot(size, answer.tractions[i]);
    }
    CHECK(apart <= 1e-6 * size);
    // Which cells touch is told by other deviations than `solve`'s, which follow each frame.
    CHECK(estimate.contact);
    CHECK_THAT(estimate.normal_force, WithinRel(answer.wrench.normal.value, 0.05));
    CHECK_THAT(estimate.centre, WithinAbs(answer.wrench.centre_y->value, 0.05));
    CHECK_THAT(estimate.centre_z, WithinAbs(answer.wrench.centre_z->value, 0.05));
  }
}

TEST_CASE("a plan for more memory than there is is refused before it is made", "[lab][skin]") {
  const SkinScene scene = skin_problem("").scene();
  CHECK_NOTHROW(lab::check_memory(scene, 1e9));
  CHECK_THROWS_WITH(lab::check_memory(scene, 1e3),
                    ContainsSubstring("147 readings to 867 tractions takes") &&
                        ContainsSubstring("wider reconstruct.spacing"));
}
