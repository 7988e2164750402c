// Plans of lines and of skins from their scenes.
#include "tactile_net/lab/planned_controller.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/lab/laws.hpp"
#include "tests/replaced.hpp"

using namespace tactile_net;
using namespace tactile_net::laws;

namespace {

const std::string own_weight = "[reconstruct]\ntangential_weight = 1.0\n";
const std::string stated_alpha = own_weight + "alpha = 1e-4\n";

}  // namespace

TEMPLATE_TEST_CASE("a plan's alpha is given, its contact's, or the median of a recording's",
                   "[lab][controller]", Lines, Skins) {
  const TestType given(scene<TestType>(stated_alpha));
  const auto alpha = lab::plan_alpha(given.problem, [](std::span<double>) -> bool {
    FAIL("a given alpha asks for no frame");
    return false;
  });
  REQUIRE(alpha);
  CHECK(alpha->value == 1e-4);
  CHECK(alpha->source == lab::PlanAlpha::Source::given);
  CHECK_FALSE(alpha->rule);

  const TestType ruled(scene<TestType>());
  const std::vector<double> g = ruled.readings();
  const auto of_contact = lab::plan_alpha(ruled.problem);
  REQUIRE(of_contact);
  CHECK(of_contact->source == lab::PlanAlpha::Source::contact);
  CHECK(of_contact->rule == ruled.problem.alpha_rule(ruled.analysed(g)));
  CHECK(of_contact->value == ruled.solve(g).alpha.value);

  const std::vector<double> sizes{1.0, 10.0, 0.1};
  std::vector<double> each;
  for (const double size : sizes) each.push_back(ruled.solve(scaled(g, size)).alpha.value);
  std::sort(each.begin(), each.end());
  const auto of_frames =
      lab::plan_alpha(ruled.problem, [&, k = std::size_t{0}](std::span<double> out) mutable {
        if (k == sizes.size()) return false;
        std::ranges::copy(scaled(g, sizes[k++]), out.begin());
        return true;
      });
  REQUIRE(of_frames);
  CHECK(of_frames->source == lab::PlanAlpha::Source::recording);
  CHECK(of_frames->frames == sizes.size());
  CHECK(of_frames->value == each[1]);

  // Without a frame a rule has nothing to choose an alpha by.
  CHECK_FALSE(lab::plan_alpha(TestType(TestType::sensor + pad + own_weight).problem));
  CHECK_FALSE(lab::plan_alpha(ruled.problem, [](std::span<double>) { return false; }));
}

TEMPLATE_TEST_CASE("the scene fills in what a plan's options leave open", "[lab][controller]",
                   Lines, Skins) {
  const std::string title = GENERATE("", "title = \"a pad\"\n");
  const bool dead = GENERATE(false, true);
  const bool converted = GENERATE(false, true);
  const TestType sensor(title + TestType::sensor + pad + "[noise]\nrms = 0.02\n" + stated_alpha +
                        (converted ? "[quantization]\nbits = 12\nrange = [-2.0, 3.0]\n" : "") +
                        (dead ? "[dead_taxels]\nindices = [0, 7]\n" : ""));
  const EstimatorPlan plan =
      lab::plan_controller(sensor.problem, {.value = 1e-3}, {.friction_coefficient = 0.7})
          .estimator.plan;
  CHECK(plan.alpha == 1e-3);
  CHECK(plan.friction_coefficient == 0.7);
  CHECK(plan.label == (title.empty() ? sensor.problem.scene().file : "a pad"));
  CHECK(plan.readings() == TestType::taxels * TestType::channels);
  CHECK(plan.fill.has_value() == dead);
  CHECK(plan.reconstruction.structure == Structure::reflections);
  CHECK(plan.traction_limit == 1.0);
  CHECK_THAT(plan.noise_rms,
             WithinRel(std::hypot(0.02, converted ? 5.0 / 4095.0 / std::sqrt(12.0) : 0.0), 1e-12));
  REQUIRE(plan.ranges.size() == (converted ? TestType::channels : 0));
  for (const auto& range : plan.ranges) {
    CHECK(range.lowest == -2.0);
    CHECK(range.highest == 3.0);
  }
}

TEMPLATE_TEST_CASE("a plan's force beside the solver's: the same, but for constraints",
                   "[lab][controller]", Lines, Skins) {
  const auto force_of = [](const std::string& reconstruct, bool raw = false) {
    const TestType sensor(scene<TestType>(
        stated_alpha + reconstruct + (raw ? "[calibration]\ngain = 0.25\noffset = 0.5\n" : "")));
    const lab::PlannedController planned =
        lab::plan_controller(sensor.problem, *lab::plan_alpha(sensor.problem));
    return lab::planned_force(sensor.problem, planned.estimator.plan).value();
  };
  const lab::PlannedForce free = force_of("");
  // A skin's solver sums what touches.
  CHECK_THAT(free.planned, WithinRel(free.solved, std::is_same_v<TestType, Lines> ? 1e-6 : 0.05));
  CHECK_THAT(force_of("", true).planned, WithinRel(free.planned, 1e-6));
  const lab::PlannedForce bound = force_of("nonnegative = true\n");
  CHECK_THAT(bound.planned, WithinRel(free.planned, 1e-6));
  CHECK(std::abs(bound.solved - bound.planned) > 1e-4 * bound.solved);
  const TestType empty(TestType::sensor + pad + stated_alpha);
  CHECK_FALSE(lab::planned_force(
      empty.problem,
      lab::plan_controller(empty.problem, *lab::plan_alpha(empty.problem)).estimator.plan));
}

TEST_CASE("a line's plan knows the array's ends", "[lab][controller]") {
  const Lines sensor(scene<Lines>(stated_alpha));
  CHECK(lab::plan_controller(sensor.problem, {.value = 1e-4}).estimator.plan.border ==
        std::vector<std::uint32_t>{0, Lines::taxels - 1});
}

TEMPLATE_TEST_CASE("a controller finds the force and the place that solve finds",
                   "[lab][controller]", Lines, Skins) {
  const std::string dead = GENERATE("", "[dead_taxels]\nindices = [0, 19]\n");
  const std::string toml =
      scene<TestType>(own_weight + "alpha = \"aicc\"\n", "[noise]\nrms = 1e-4\n") + dead;
  const std::string pitch =
      toml.substr(toml.find("pitch"), toml.find("reads") - toml.find("pitch"));
  const TestType sensor(replaced(toml, pitch, "pitch = 1.0\ndepth = 1.0\n"));
  ContactEstimator estimator(
      lab::plan_controller(sensor.problem, *lab::plan_alpha(sensor.problem)).estimator.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  const std::vector<double> readings = sensor.readings();
  REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
  const FrameNumbers solved = sensor.solve(readings);
  // Which cells touch is told by other deviations than `solve`'s, which follow each frame.
  CHECK(apart(f, solved.tractions) < 1e-6);
  CHECK_THAT(estimate.normal_force, WithinRel(solved.force.value, 0.05));
  REQUIRE_FALSE(solved.centre.empty());
  CHECK_THAT(estimate.centre, WithinAbs(solved.centre[0].value, 0.05));
  if (solved.centre.size() > 1)
    CHECK_THAT(estimate.centre_z, WithinAbs(solved.centre[1].value, 0.05));
}

TEST_CASE("a plan for more memory than there is is refused before it is made", "[lab][skin]") {
  const Skins sensor(scene<Skins>());
  CHECK_NOTHROW(lab::check_memory(sensor.problem.scene(), 1e9));
  CHECK_THROWS_WITH(
      lab::check_memory(sensor.problem.scene(), 1e3),
      ContainsSubstring("90 readings to ") && ContainsSubstring("wider reconstruct.spacing"));
}
