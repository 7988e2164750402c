// The tangential traction's weight and the active set's alpha, from a scene's text to its answer.
#include "tactile_net/inverse/tangential_weight.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/planned_controller.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/summary.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/lab/laws.hpp"
#include "tests/lab/scene_parts.hpp"

using namespace tactile_net::laws;

namespace tactile_net::lab {
namespace {

constexpr double relative_noise = 0.002;

Scene tangential_pad(const std::string& reads, const std::string& reconstruct,
                     double stiffness = 1.0, double length = 1.0) {
  const auto number = [](double value) { return std::to_string(value); };
  return parse_scene(
      "[sensor]\ncount = 33\npitch = " + number(0.5 * length) + "\ndepth = " + number(length) +
          "\nreads = [" + reads + "]\n[material]\nyoungs_modulus = " + number(stiffness) +
          "\npoisson_ratio = 0.45\n[noise]\nrms = " + number(relative_noise * stiffness) +
          "\n[reconstruct]\ntangential = true\n" + reconstruct,
      "pad.toml");
}

const std::string with_shear = "\"stress_x\", \"shear_xy\"";
const std::string two_stresses = "\"stress_x\", \"stress_y\"";

struct Frame {
  std::vector<double> readings{};
  std::vector<double> truth{};
};

/// A strip that presses with 0.1 E or so and drags, with noise.
Frame noisy_frame(const Scene& scene, double friction, double center, unsigned seed) {
  const double depth = scene.sensor.depths.front();
  const std::vector<Contact> contacts{
      RigidContact{.center = center * depth,
                   .half_width = 1.3 * depth,
                   .force = 0.3 * scene.material.youngs_modulus * depth,
                   .friction = friction}};
  Frame frame{.readings = exact_readings(scene.sensor, scene.material, contacts)};
  add_noise(frame.readings, relative_noise * scene.material.youngs_modulus, seed, 0);
  const TractionField field = sample(contacts, surface(scene));
  frame.truth = field.normal;
  frame.truth.insert(frame.truth.end(), field.tangential.begin(), field.tangential.end());
  frame.truth.resize(2 * field.normal.size());  // of a press: nothing drags
  return frame;
}

struct SolvedFrame {
  FrameResult result{};
  std::vector<double> f{};
};
SolvedFrame solved_frame(const SceneProblem& problem, std::span<const double> readings,
                         Method method = Method::tikhonov) {
  const auto solver = make_solver(problem, method);
  SolvedFrame answer{.f = std::vector<double>(solver->tractions())};
  answer.result = solver->solve(readings, answer.f);
  REQUIRE(answer.result.status == FrameStatus::ok);
  return answer;
}

/// The tangential force over the normal one.
double drag(const SolvedFrame& answer) {
  const auto middle = answer.f.begin() + std::ssize(answer.f) / 2;
  return std::accumulate(middle, answer.f.end(), 0.0) /
         std::accumulate(answer.f.begin(), middle, 0.0);
}

double error(const SolvedFrame& answer, const Frame& frame) {
  return relative_l2_error(answer.f, frame.truth);
}

}  // namespace

TEMPLATE_TEST_CASE("a stated weight of 1 is none, the same bits", "[lab][weights]", Lines, Skins) {
  const std::string rest =
      "[reconstruct]\ntangential = true\n" +
      GENERATE(as<std::string>{}, "", "alpha = 1e-4\n", "friction_limit = 0.8\n");
  const TestType plain(scene<TestType>(rest));
  const std::vector<double> g = plain.readings();
  const FrameNumbers found = plain.solve(g);
  const FrameNumbers one = TestType(scene<TestType>(rest + "tangential_weight = 1\n")).solve(g);
  CHECK(one.tractions == found.tractions);
  CHECK(one.alpha.value == found.alpha.value);
  CHECK_FALSE(one.alpha.tangential_weight.has_value());
}

TEMPLATE_TEST_CASE("an estimated weight is the answer that stating it gives", "[lab][weights]",
                   Lines, Skins) {
  const std::string rest =
      "[reconstruct]\ntangential = true\n" + GENERATE(as<std::string>{}, "", "alpha = 1e-4\n",
                                                      "friction_limit = 0.8\n",
                                                      "offset = true\nnonnegative = true\n");
  CAPTURE(rest);
  const TestType sensor(scene<TestType>(rest + "answer = \"alpha\"\n" + estimated_weight));
  REQUIRE(sensor.problem.estimates_weight());
  const std::vector<double> g = sensor.readings();
  const FrameNumbers found = sensor.solve(g);
  REQUIRE(found.alpha.tangential_weight.has_value());
  CHECK(*found.alpha.tangential_weight != 1.0);
  auto with_weight = sensor.problem.scene();
  with_weight.reconstruct.tangential_weight = found.alpha.tangential_weight;
  const FrameNumbers stated = TestType(with_weight).solve(g);
  CHECK(apart(found.tractions, stated.tractions) < 1e-9);
  CHECK_THAT(found.alpha.value, WithinRel(stated.alpha.value, 1e-12));
  CHECK(found.remarks.size() == stated.remarks.size() + 1);  // it is named
  // A line's bands are over all weights that are likely.
  if (std::is_same_v<TestType, Skins>) CHECK(found.force.deviation == stated.force.deviation);
}

TEMPLATE_TEST_CASE("who needs one functional for all frames asks for the weight", "[lab][weights]",
                   Lines, Skins) {
  const std::string rest = "[reconstruct]\ntangential = true\n";
  const TestType sensor(scene<TestType>(rest + estimated_weight));
  CHECK_THROWS_WITH(plan_controller(sensor.problem, {.value = 1e-3}, {}),
                    ContainsSubstring("tangential_weight") && ContainsSubstring("state it"));
  CHECK_THROWS_WITH(sensor.solver({.share_alpha = 5}),
                    ContainsSubstring("tangential_weight") && ContainsSubstring("state it"));
  const TestType stated(scene<TestType>(rest + "tangential_weight = 2\n"));
  CHECK_NOTHROW(plan_controller(stated.problem, {.value = 1e-3}, {}));
}

TEST_CASE("a line's methods ask for the weight, or find it", "[lab][weights]") {
  const SceneProblem problem(tangential_pad(with_shear, estimated_weight));
  CHECK_THROWS_WITH(make_solver(problem, Method::dft), ContainsSubstring("tangential_weight"));
  CHECK_THROWS_WITH(
      make_sharing_solver(SceneProblem(tangential_pad(
                              with_shear, "nonnegative = true\nalpha_on_active_set = true\n")),
                          Method::tikhonov, 5),
      ContainsSubstring("alpha_on_active_set"));
  Scene many = tangential_pad(with_shear, estimated_weight);
  many.sensor.count = 600;
  const auto solver = make_solver(many, Method::tikhonov);
  std::vector<double> f(solver->tractions());
  CHECK_THROWS_WITH((void)solver->solve(std::vector<double>(1200, 1.0), f),
                    ContainsSubstring("state it"));

  const Frame frame = noisy_frame(problem.scene(), 0.25, 0.4, 2);
  const SceneFrame analysed(problem, frame.readings);
  const double weight = analysed.estimated_weight().value();
  double sum = 0.0;
  for (const SceneFrame::LikelyWeight& one : analysed.likely_weights()) sum += one.probability;
  CHECK_THAT(sum, WithinRel(1.0, 1e-12));
  Scene stated = tangential_pad(with_shear, "");
  stated.reconstruct.tangential_weight = weight;
  const SolvedFrame found = solved_frame(problem, frame.readings, Method::closed_form);
  const SolvedFrame expected =
      solved_frame(SceneProblem(stated), frame.readings, Method::closed_form);
  CHECK(found.result.alpha->tangential_weight == weight);
  CHECK(relative_l2_error(found.f, expected.f) < 1e-9);
}

TEST_CASE("the evidence of the weight makes tractions better, the null mode of two stresses first",
          "[lab][weights]") {
  for (const std::string& reads : {with_shear, two_stresses}) {
    const SceneProblem one(tangential_pad(reads, "alpha = \"evidence\"\n"));
    const SceneProblem own(tangential_pad(reads, "alpha = \"evidence\"\n" + estimated_weight));
    std::vector<double> before, after;
    double mode_before = 0.0;  // drag that a press does not have
    double mode_after = 0.0;
    for (unsigned i = 0; i < 12; ++i) {
      const Frame frame = noisy_frame(one.scene(), i % 2 == 0 ? 0.0 : 0.3, 0.3 * i - 2.0, i);
      const SolvedFrame plain = solved_frame(one, frame.readings);
      const SolvedFrame weighed = solved_frame(own, frame.readings);
      before.push_back(error(plain, frame));
      after.push_back(error(weighed, frame));
      if (i % 2 == 0) {
        mode_before = std::max(mode_before, std::abs(drag(plain)));
        mode_after = std::max(mode_after, std::abs(drag(weighed)));
      }
    }
    std::sort(before.begin(), before.end());
    std::sort(after.begin(), after.end());
    CAPTURE(reads, before, after, mode_before, mode_after);
    CHECK(after[6] < 0.9 * before[6]);
    CHECK(after.back() < 1.05 * before.back());
    if (reads == two_stresses) CHECK(mode_after < 0.25 * mode_before);
  }
}

TEST_CASE("neither the unit of stress nor that of length chooses weight or alpha",
          "[lab][weights][property]") {
  const std::string rest = estimated_weight +
                           "friction_limit = 0.8\nalpha = \"evidence\"\n"
                           "alpha_on_active_set = true\n";
  const double stiffness = GENERATE(1.0, 1024.0);
  const double length = GENERATE(1.0, 0.0625);
  const SceneProblem here(tangential_pad(with_shear, rest));
  const SceneProblem there(tangential_pad(with_shear, rest, stiffness, length));
  const Frame frame = noisy_frame(here.scene(), 0.25, 0.4, 2);
  std::vector<double> readings = frame.readings;
  for (double& reading : readings) reading *= stiffness;
  const SolvedFrame found = solved_frame(here, frame.readings);
  const SolvedFrame scaled = solved_frame(there, readings);
  CHECK(*scaled.result.alpha->tangential_weight == *found.result.alpha->tangential_weight);
  CHECK_THAT(scaled.result.alpha->value, WithinRel(found.result.alpha->value, 1e-6));
  std::vector<double> expected = found.f;
  for (double& f : expected) f *= stiffness;
  CHECK(relative_l2_error(scaled.f, expected) < 1e-6);
}

TEST_CASE("an active set's alpha is what the rule chooses on the tractions left free",
          "[lab][constrained]") {
  const std::string rule = GENERATE("evidence", "rgcv", "aicc");
  CAPTURE(rule);
  const std::string rest = "friction_limit = 0.8\nalpha = \"" + rule + "\"\n";
  const SceneProblem problem(tangential_pad(with_shear, rest + "alpha_on_active_set = true\n"));
  REQUIRE(problem.chooses_on_active_set());
  const Frame frame = noisy_frame(problem.scene(), 0.25, 0.4, 3);
  const SolvedFrame found = solved_frame(problem, frame.readings);
  CHECK(name(*found.result.alpha->rule) == rule);
  REQUIRE(found.result.constrained.has_value());
  const TikhonovFamily face(
      problem.problem(),
      active_face(problem.problem(), *problem.constraints(), found.result.constrained->free));
  const AlphaChoice own =
      choose_alone(face.analyse(frame.readings), *found.result.alpha->rule, problem.stated_noise());
  CHECK_THAT(found.result.alpha->value, WithinRel(own.alpha, 0.05));
  const SolvedFrame before =
      solved_frame(SceneProblem(tangential_pad(with_shear, rest)), frame.readings);
  CHECK(before.result.alpha->value != found.result.alpha->value);
}

TEST_CASE("bands of an estimated weight are those over all that are likely", "[lab][bands]") {
  const std::string rest = GENERATE("", "friction_limit = 0.8\n", "surface = \"grid\"\n");
  CAPTURE(rest);
  const SceneProblem problem(tangential_pad(with_shear, rest + estimated_weight));
  const Frame frame = noisy_frame(problem.scene(), 0.1, 0.4, 2);
  const SceneFrame analysed(problem, frame.readings);
  REQUIRE(analysed.likely_weights().size() > 1);
  const SolvedFrame found = solved_frame(problem, frame.readings);
  const FrameUncertainty bands = uncertainty(analysed, found.f, found.result);
  double expected = 0.0;  // of the tangential force's variance
  for (const auto& [weight, probability] : analysed.likely_weights()) {
    const FrameUncertainty one = uncertainty(analysed.weighed(weight), found.f, found.result);
    expected += probability * std::pow(one.resultant.tangential->deviation, 2);
  }
  CHECK_THAT(bands.resultant.tangential->deviation, WithinRel(std::sqrt(expected), 1e-9));
  CHECK(bands.deviation.size() == found.f.size());
}

TEST_CASE("bands under constraints hold the answer without them", "[lab][bands]") {
  const SceneProblem problem(tangential_pad(with_shear, "friction_limit = 0.8\n"));
  const SceneProblem plain(tangential_pad(with_shear, ""));
  const Frame frame = noisy_frame(problem.scene(), 0.25, 0.4, 2);
  const SolvedFrame found = solved_frame(problem, frame.readings);
  const SolvedFrame other = solved_frame(plain, frame.readings);
  const UncertainResultant own =
      uncertainty(SceneFrame(problem, frame.readings), found.f, found.result).resultant;
  const UncertainResultant free =
      uncertainty(SceneFrame(plain, frame.readings), other.f, other.result).resultant;
  CHECK(own.normal.deviation > 0.9 * free.normal.deviation);
  CHECK(std::abs(own.normal.value - free.normal.value) < 2.0 * own.normal.deviation);
}

TEST_CASE("a recording tells which weights its frames have", "[lab][weights]") {
  SolvedFrames solved;
  solved.add({.alpha = ChosenAlpha{.value = 1.0}});
  CHECK_FALSE(solved.least_weight.has_value());
  for (const double weight : {4.0, 1.0, 64.0})
    solved.add({.alpha = ChosenAlpha{.value = 1.0, .tangential_weight = weight}});
  CHECK(solved.least_weight == 1.0);
  CHECK(solved.largest_weight == 64.0);
}

}  // namespace tactile_net::lab
