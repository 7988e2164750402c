// What a page says first.
#include "tactile_net/report/words/answers.hpp"

#include <numbers>
#include <string>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/report/measured_study.hpp"

namespace tactile_net::report {
namespace {

Scene pad(const std::string& more = "") {
  return parse_scene(
      "[sensor]\ncount = 21\npitch = 0.5\ndepth = 1.0\nreads = [\"stress_x\"]\n[material]\n"
      "youngs_modulus = 1.0\npoisson_ratio = 0.45\n[[contact]]\nshape = \"cylinder\"\n"
      "half_width = 2.0\nforce = 1.0\n[noise]\nrms = 1e-3\n[reconstruct]\nalpha = 1e-3\n" +
          more,
      "pad.toml");
}

lab::MethodResult found(Method method, double height) {
  const UncertainResultant resultant{.normal = {0.9999, 0.0021}, .centre = Uncertain{1e-9, 0.008}};
  return {.method = method,
          .answer = {.tractions = std::vector<double>(21, height),
                     .bands = lab::FrameUncertainty{.resultant = resultant}},
          .errors = {{.relative = 0.1}}};
}

lab::Experiment experiment(std::vector<lab::MethodResult> results) {
  lab::Experiment one;
  one.scene = pad();
  one.sampled_force = 1.0;
  one.results = std::move(results);
  one.frame.force = 1.0;
  return one;
}

bool doubtful(const std::vector<Answer>& all) {
  for (const Answer& answer : all)
    if (answer.doubtful) return true;
  return false;
}

}  // namespace

TEST_CASE("a run answers how hard, where, how far off, and whether the methods agree",
          "[report][answers]") {
  const auto all =
      answers(experiment({found(Method::tikhonov, 1.0), found(Method::closed_form, 1.0 + 1e-11)}));
  REQUIRE(all.size() == 4);
  CHECK(all[0].value == "1.000 ± 0.002");
  CHECK(all[1].value == "0.000 ± 0.008");
  CHECK(all[2].value == "10 % off");
  CHECK(all[3].value == "2 methods agree");
  CHECK_THAT(all[3].meaning, StartsWith("to 1e-11 of"));
  CHECK_FALSE(doubtful(all));
}

TEST_CASE("what speaks against a run's answer is told in its box", "[report][answers]") {
  lab::Experiment one = experiment({found(Method::tikhonov, 1.0), found(Method::closed_form, 1.1)});
  CHECK(answers(one).back().doubtful);
  CHECK_THAT(answers(one).back().meaning,
             ContainsSubstring("closed_form differs from tikhonov by up to 10 %"));

  one.results.back().answer.tractions.clear();
  CHECK(answers(one).back().value == "1 of 2 methods fail");

  one = experiment({found(Method::tikhonov, 1.0)});
  CHECK_FALSE(doubtful(answers(one)));
  one.sampled_force = 0.9;
  CHECK_FALSE(doubtful(answers(one)));  // readings are integrals: they hold the whole force
  std::get<Scene>(one.scene).forward = ForwardModel::sampled;
  CHECK(answers(one).front().doubtful);

  one = experiment({found(Method::tikhonov, 1.0)});
  one.results.front().answer.verdict = lab::Verdict::unstable;
  CHECK(answers(one).front().doubtful);
  CHECK_THAT(answers(one).front().meaning, ContainsSubstring("unstable: "));

  one.frame.force = 0.0;
  CHECK(answers(one).front().value == "nothing presses");

  one.results.front().answer.tractions.clear();
  CHECK(answers(one).front().value == "no answer");
}

TEST_CASE("sensors answer from which wavelength on they tell, and what they hide",
          "[report][answers]") {
  const Scene scene = pad();
  lab::Survey survey = lab::identify(scene);
  const auto all = answers(survey, scene.units);
  REQUIRE(all.size() == 4);
  CHECK_THAT(all[0].value, StartsWith("from "));
  CHECK(all[1].value == "not measured");
  CHECK(all[2].value == "nothing hidden");
  survey.own.wavelengths = {};
  survey.own.array->hidden = 2;
  survey.advice = {};
  CHECK(answers(survey, scene.units)[0].doubtful);
  CHECK(answers(survey, scene.units)[2].value == "2 are hidden");
  CHECK(answers(survey, scene.units)[3].value == "keep them");
}

TEST_CASE("a circuit answers whether it settles, how fast, and at what cost", "[report][answers]") {
  const lab::Certification c =
      lab::certify(pad("[network]\nrealization = \"least_squares\"\nopamp = { bandwidth = 10e6 }\n"
                       "tolerance = { relative = 0.01 }\n"));
  const auto all = answers(c);
  REQUIRE(all.size() == 4);
  CHECK(all[0].value == "stable");
  CHECK_THAT(all[0].meaning, StartsWith("least_squares, proven by theorem"));
  CHECK_THAT(all[1].value, EndsWith("us") || EndsWith("ns"));
  CHECK_THAT(all[2].value, EndsWith("op-amps"));
  CHECK_THAT(all[3].value, EndsWith("% yield"));
}

TEST_CASE("a study answers with the command that makes its fastest plan", "[report][answers]") {
  const auto all = answers(study::by_hand::measured());
  REQUIRE(all.size() == 4);
  CHECK(all[0].value == "57.8 ns a frame");
  CHECK_THAT(all[0].meaning, ContainsSubstring("tactile-net plan pressed.toml --accuracy 1e-2"));
  CHECK(all[1].value == "9.1 % from the truth");
  CHECK(all[3].value == "445 ns to settle");
}

TEST_CASE("a grasp answers whether it holds, and what is nearest to its limit",
          "[report][answers]") {
  lab::GraspResult grasp;
  grasp.tips.resize(2);
  grasp.tips[0].finger.name = "left";
  grasp.tips[1].finger.name = "right";
  lab::HeldAnswer held;
  held.margins = {
      {.friction = FrictionMargin{.angle = 0.3}, .torques = {{.used = 0.2}, {.used = 0.55}}},
      {.friction = FrictionMargin{.angle = 8.7 * std::numbers::pi / 180.0},
       .torques = {{.used = 0.1}}}};
  grasp.held = held;
  auto all = answers(grasp);
  REQUIRE(all.size() == 3);
  CHECK(all[0].value == "Both fingers hold");
  CHECK(all[1].value == "8.7° to slipping");
  CHECK_THAT(all[1].meaning, ContainsSubstring("right"));
  CHECK(all[2].value == "55 % of torque");
  CHECK_THAT(all[2].meaning, ContainsSubstring("joint 2 of left"));
  CHECK_FALSE(doubtful(all));

  grasp.held->margins[0].friction->angle = -0.1;
  grasp.failures = {{.kind = lab::GraspFailure::Kind::slips,
                     .answer = lab::GraspAnswer::held,
                     .finger = 0,
                     .number = 0.5}};
  all = answers(grasp);
  CHECK(all[0].value == "It fails");
  CHECK(all[0].doubtful);
  CHECK(all[1].value == "5.7° beyond slipping");
}

}  // namespace tactile_net::report
