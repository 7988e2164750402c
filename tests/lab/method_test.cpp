#include "tactile_net/lab/method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

Scene scene_that_reads(const std::string& reads, const std::string& rest) {
  return parse_scene("[sensor]\ncount = 41\npitch = 0.5\ndepth = 1.5\nreads = [" + reads +
                         "]\n"
                         "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n" +
                         rest,
                     "scene.toml");
}

const std::string one_stress = "\"stress_x\"";
const std::string two = "\"stress_x\", \"shear_xy\"";

/// A bump in the array's middle, 41 values a channel.
std::vector<double> bump(std::size_t channels) {
  std::vector<double> readings;
  for (std::size_t c = 0; c < channels; ++c)
    for (int i = -20; i <= 20; ++i)
      readings.push_back((c == 0 ? 1.0 : 0.1 * i) * std::exp(-0.05 * i * i));
  return readings;
}

bool ignores_constraints(const Remarks& remarks) {
  return std::any_of(remarks.begin(), remarks.end(), [](const Remark& one) {
    return std::holds_alternative<remark::ConstraintsIgnored>(one);
  });
}

}  // namespace

TEST_CASE("a frame is refused where any of its tractions overflows", "[lab][method]") {
  const auto [method, reads, rest] = GENERATE(table<Method, std::string, std::string>({
      {Method::tikhonov, one_stress, "[reconstruct]\nalpha = 1e-3\n"},
      {Method::tikhonov, one_stress, ""},
      {Method::tikhonov, two, "[reconstruct]\nalpha = 1e-3\ntangential = true\n"},
      {Method::closed_form, one_stress, "[reconstruct]\nalpha = 1e-3\n"},
      {Method::dft, one_stress, ""},
      {Method::dft, two, "[reconstruct]\nalpha = 1e-3\ntangential = true\n"},
  }));
  const Scene scene = scene_that_reads(reads, rest);
  const double size = GENERATE(1e306, 1.7e308);
  CAPTURE(name(method), reads, rest, size);
  const auto solver = make_solver(scene, method);
  std::vector<double> readings = bump(scene.sensor.reads.size());
  std::vector<double> f(solver->tractions());
  REQUIRE(solver->solve(readings, f).status == FrameStatus::ok);

  readings[39] = size;
  readings[40] = -size;
  std::vector<double> untouched(f.size(), 7.0);
  const FrameResult result = solver->solve(readings, untouched);
  if (result.status == FrameStatus::ok) {  // large, and still in range: then all of it is
    CHECK(
        std::all_of(untouched.begin(), untouched.end(), [](double v) { return std::isfinite(v); }));
  } else {
    CHECK(result.status == FrameStatus::too_large);
    CHECK(untouched == std::vector<double>(f.size(), 7.0));
  }
  // A rule may choose an alpha that keeps even these in range; a given one does not.
  const bool given = scene.reconstruct.alpha.has_value() || method == Method::dft;
  if (size > 1e308 && given) CHECK(result.status == FrameStatus::too_large);
}

TEST_CASE("a frame of another size, or with NaN, is refused and leaves the room alone",
          "[lab][method]") {
  const std::string rest = GENERATE("", "[reconstruct]\nalpha = 1e-3\n",
                                    "[reconstruct]\nalpha = 1e-3\nnonnegative = true\n");
  const Method method = GENERATE(Method::dft, Method::tikhonov, Method::closed_form);
  CAPTURE(rest, name(method));
  const auto solver = make_solver(scene_that_reads(one_stress, rest), method);
  std::vector<double> f(solver->tractions(), 7.0);
  CHECK(solver->solve(std::vector<double>(40), f).status == FrameStatus::wrong_size);
  std::vector<double> readings = bump(1);
  CHECK(solver->solve(readings, std::span(f).first(3)).status == FrameStatus::wrong_size);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    readings[7] = bad;
    CHECK(solver->solve(readings, f).status == FrameStatus::not_finite);
  }
  CHECK(f == std::vector<double>(f.size(), 7.0));
}

TEST_CASE("the bands' prior is gml judged alone, whatever the other rules say", "[lab][bands]") {
  // Three times the noise stated and an outlier: the rules disagree here, gml by itself is
  // sure.
  Scene scene = scene_that_reads(one_stress, "[noise]\nrms = 1e-3\n");
  scene.sensor.depths = {1.9 * scene.sensor.pitch};  // not dense: no windows
  const SceneProblem problem(scene);
  REQUIRE(!problem.has_load_windows());
  const auto solver = make_solver(problem, Method::tikhonov);
  std::size_t disagreements = 0;
  for (int k = 1; k <= 40; ++k) {
    std::vector<double> readings = bump(1);
    for (std::size_t i = 0; i < readings.size(); ++i)
      readings[i] =
          readings[i] / k + 3e-3 * std::sin(12.9898 * static_cast<double>(i * 7 + 13) * k);
    readings[static_cast<std::size_t>(k)] += 0.3 / k;
    const SceneFrame frame(problem, readings);
    const AlphaChoice heard =
        choose_alpha(frame.analysed(), AlphaRule::gml, problem.stated_noise());
    if (heard.verdict == AlphaVerdict::rules_disagree) ++disagreements;

    std::vector<double> f(solver->tractions());
    const FrameResult result = solver->solve(readings, f);
    const FrameUncertainty bands = uncertainty(frame, f, result);
    const AlphaChoice alone =
        choose_alone(frame.analysed(), AlphaRule::gml, problem.stated_noise());
    const double prior = alone.verdict == AlphaVerdict::ok ? alone.alpha : result.alpha->value;
    const TractionCovariance covariance(problem.family(), result.alpha->value, prior);
    std::vector<double> expected = covariance.deviations();
    for (double& deviation : expected) deviation *= bands.noise.rms();
    CHECK(bands.deviation == expected);
  }
  CHECK(disagreements > 0);  // else this tells nothing
}

TEST_CASE("every verdict and every method has a name of its own", "[lab][method]") {
  std::vector<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(Verdict::coarse); ++i)
    names.push_back(name(static_cast<Verdict>(i)));
  CHECK(std::none_of(names.begin(), names.end(), [](auto text) { return text.empty(); }));
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
  for (const MethodTraits& row : methods()) CHECK(&traits(row.method) == &row);
}

TEST_CASE("where a rule chooses alpha the condition is a bound, close to that of a given alpha",
          "[lab][method]") {
  Scene scene = read_scene(SCENES "/thesis/cylinder.toml");
  const std::vector<double> readings = simulate(scene).readings;
  for (const double smoothing : {0.1, 1.0, 5.0}) {
    scene.reconstruct.smoothing_length = smoothing;
    scene.reconstruct.alpha.reset();
    std::vector<double> f(scene.sensor.count);
    const FrameResult chosen = make_solver(scene, Method::tikhonov)->solve(readings, f);
    REQUIRE(chosen.condition);
    CHECK(chosen.condition->kind == Condition::Kind::bound);
    scene.reconstruct.alpha = chosen.alpha->value;
    const FrameResult given = make_solver(scene, Method::tikhonov)->solve(readings, f);
    CHECK(given.condition->kind == Condition::Kind::exact);
    CHECK(given.condition->matrix == chosen.condition->matrix);
    CHECK(chosen.condition->value >= given.condition->value);
    const double of_stabiliser = std::hypot(1.0, 2.0 * smoothing / scene.sensor.pitch);
    CHECK(chosen.condition->value <= of_stabiliser * of_stabiliser * given.condition->value);
  }
  std::vector<double> f(scene.sensor.count);
  const FrameResult eliminated = make_solver(scene, Method::closed_form)->solve(readings, f);
  CHECK(eliminated.condition->matrix == Condition::Matrix::eliminated);
}

TEST_CASE("a method that does not know the scene's constraints says so in its verdict",
          "[lab][method]") {
  Scene scene = read_scene(SCENES "/thesis/cylinder.toml");
  scene.reconstruct.methods = {Method::tikhonov, Method::closed_form, Method::dft};
  Ngspice not_needed;
  for (const bool constrained : {false, true}) {
    scene.reconstruct.nonnegative = constrained;
    for (const MethodResult& result : run(scene, not_needed).results) {
      const bool knows = traits(result.method).takes_constraints;
      CHECK((result.answer.verdict == Verdict::unconstrained) == (constrained && !knows));
      // A recording's frame says what run says of the same readings, and so do its bands.
      const AnyProblem problem = SceneProblem(scene);
      RecordingSolver recorded(problem, result.method);
      std::vector<double> readings = simulate(scene).readings;
      const auto frame = recorded.solve(readings);
      REQUIRE(frame);
      CHECK((frame->verdict == Verdict::unconstrained) == (constrained && !knows));
      CHECK(ignores_constraints(frame->remarks) == (constrained && !knows));
      if (!traits(result.method).has_bands) continue;
      const FrameAnswer again = with_bands(recorded.problem(), readings, *frame);
      CHECK((again.verdict == Verdict::unconstrained) == (constrained && !knows));
      CHECK(ignores_constraints(again.remarks) == (constrained && !knows));
    }
  }
}

TEST_CASE("dft takes no surface but the taxels", "[lab][method]") {
  for (const std::string& reads : {one_stress, two}) {
    Scene scene = scene_that_reads(reads, "");
    scene.reconstruct.surface.basis = SurfaceBasis::hats;
    const SceneProblem problem(scene);
    CHECK_THROWS_WITH(make_solver(problem, Method::dft, 1e-3),
                      ContainsSubstring("surface = \"taxels\""));
    CHECK_NOTHROW(make_solver(problem, Method::tikhonov, 1e-3));
    CHECK_NOTHROW(make_solver(problem, Method::closed_form, 1e-3));
  }
}

TEST_CASE("the circuit solves no frames, and says so", "[lab][method]") {
  CHECK_THROWS_AS(make_solver(scene_that_reads(one_stress, ""), Method::network),
                  std::invalid_argument);
}

}  // namespace tactile_net::lab
