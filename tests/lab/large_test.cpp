// Where nothing dense is made any more: the answers are what they were below.
#include <algorithm>
#include <cmath>

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"

namespace tactile_net::lab {
namespace {

/// Eight values of the surface to a taxel: many tractions of few readings, so that a decomposition
/// stands beside.
Scene strip(std::size_t taxels, const std::string& rest) {
  return parse_scene("[sensor]\ncount = " + std::to_string(taxels) +
                         "\npitch = 3.0\ndepth = 1.5\nreads = [\"stress_x\"]\n"
                         "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                         "[[contact]]\nshape = \"cylinder\"\ncenter = 1.0\nhalf_width = 4.0\n"
                         "force = 1.0\n[noise]\nrms = 1e-3\n[forward]\nmodel = \"exact\"\n" +
                         rest,
                     "scene.toml");
}

}  // namespace

TEST_CASE("a large array is answered as a decomposition would", "[lab][large]") {
  const std::string rest =
      GENERATE(as<std::string>{}, "", "[dead_taxels]\nindices = [64, 65, 90]\n");
  const Scene scene = strip(131, rest);
  const SceneProblem problem(scene);
  REQUIRE(problem.is_large());
  REQUIRE(problem.sections().sections() > 1);
  const SceneFrame frame(problem, simulate(scene).readings);
  const auto solver = make_solver(problem, Method::tikhonov);
  std::vector<double> f(solver->tractions());
  const FrameResult result = solver->solve(frame.readings(), f);
  REQUIRE(result.status == FrameStatus::ok);
  CHECK(result.verdict == Verdict::ok);
  const FrameUncertainty bands = uncertainty(frame, f, result);

  const LinearProblem& whole = problem.problem();
  const TikhonovFamily family(whole);
  const FilterFrame analysed = family.analyse(frame.readings());
  const AlphaTables tables(analysed.gamma, analysed.rows);
  const AlphaRule rule = default_rule(tables, true);
  const double alpha = sweep_alpha(analysed, tables, problem.stated_noise()).choice(rule).alpha;
  REQUIRE(result.alpha);
  CHECK(result.alpha->rule == rule);
  CHECK_THAT(result.alpha->value, WithinRel(alpha, 1e-3));
  const std::vector<double> expected = family.solve(analysed, alpha);
  CHECK(relative_l2_error(f, expected) < 1e-4);

  const TractionCovariance covariance(family, alpha, alpha);  // evidence sizes the prior too
  const UncertainResultant contact = resultant_of(whole, expected, covariance, 1e-3);
  CHECK_THAT(bands.resultant.normal.value, WithinRel(contact.normal.value, 1e-4));
  CHECK_THAT(bands.resultant.normal.deviation, WithinRel(contact.normal.deviation, 1e-3));
  const std::vector<double> deviations = covariance.deviations();
  for (std::size_t i = 0; i < f.size(); ++i)
    CHECK_THAT(bands.deviation[i], WithinRel(1e-3 * deviations[i], 2e-3));
  CHECK_THAT(bands.noise.residual_rms,
             WithinRel(estimate_noise(whole, frame.readings(), expected,
                                      covariance.degrees_of_freedom(), 1e-3)
                           .residual_rms,
                       1e-4));
}

TEST_CASE("run answers a large array as its solver and its bands do, without a verdict on the data",
          "[lab][large]") {
  const Scene scene = strip(1100,
                            "[reconstruct]\nsurface = \"taxels\"\nalpha = 1e-2\n"
                            "methods = [\"tikhonov\"]\n");
  const SceneProblem problem(scene);
  REQUIRE(problem.is_large());
  const SceneFrame frame(problem, simulate(scene).readings);
  const auto solver = make_solver(problem, Method::tikhonov, 1e-2);
  std::vector<double> f(solver->tractions());
  const FrameResult expected = solver->solve(frame.readings(), f);
  const FrameUncertainty bands = uncertainty(frame, f, expected);

  Ngspice unused;
  const Experiment experiment = run(scene, unused);
  REQUIRE(experiment.succeeded());
  const MethodResult& result = experiment.results.front();
  CHECK(result.answer.verdict == expected.verdict);
  CHECK(result.answer.tractions == f);
  CHECK(result.answer.deviations == bands.deviation);
  REQUIRE(result.resultant());
  CHECK(result.resultant()->normal.value == bands.resultant.normal.value);
  CHECK(result.resultant()->normal.deviation == bands.resultant.normal.deviation);
  CHECK_FALSE(result.answer.data);
}

TEST_CASE("nothing changes where arrays become large", "[lab][large]") {
  const auto answer = [](std::size_t taxels) {
    Scene scene = strip(taxels, "[reconstruct]\nalpha = 1e-2\n");
    scene.noise->rms.begin()->second = 1e-9;  // stated, and hardly there
    const SceneProblem problem(scene);
    const SceneFrame frame(problem, simulate(scene).readings);
    const auto solver = make_solver(problem, Method::tikhonov);
    std::vector<double> f(solver->tractions());
    const FrameResult result = solver->solve(frame.readings(), f);
    REQUIRE(result.status == FrameStatus::ok);
    return std::pair(problem.is_large(), uncertainty(frame, f, result).resultant.normal);
  };
  const auto [is_large_below, below] = answer(125);
  const auto [is_large_above, above] = answer(129);  // two taxels more at either end
  REQUIRE_FALSE(is_large_below);
  REQUIRE(is_large_above);
  CHECK_THAT(above.value, WithinRel(below.value, 1e-5));
}

TEST_CASE("under constraints a large array has no bands, and says so", "[lab][large]") {
  const Scene scene = strip(131, "[reconstruct]\nnonnegative = true\nalpha = 1e-2\n");
  CHECK_FALSE(SceneProblem(scene).has_bands());
  CHECK_FALSE(workload(scene).does(Computation::bands));
  CHECK(SceneProblem(strip(131, "")).has_bands());
  CHECK(workload(strip(131, "")).does(Computation::bands));
}

}  // namespace tactile_net::lab
