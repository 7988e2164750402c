#include "tactile_net/lab/missing.hpp"

#include <cmath>
#include <memory>
#include <random>

#include "lab/pattern_cache.hpp"
#include "tactile_net/lab/frame_runs.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/scene_parts.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t taxel_count = 17;

Scene two_quantity_scene(const std::string& rest) {
  return parse_scene(
      "[sensor]\ncount = 17\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\", \"shear_xy\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n[noise]\nrms = 0.01\n" +
          rest,
      "scene.toml");
}

std::vector<double> frame(std::mt19937& draw) {
  std::vector<double> readings(2 * taxel_count);
  for (double& one : readings) one = static_cast<double>(draw()) / 4294967296.0;
  return readings;
}

}  // namespace

TEST_CASE("a frame that misses taxels is solved as the scene with these dead", "[lab][missing]") {
  const auto [method, rest] = GENERATE(table<Method, std::string>({
      {Method::tikhonov, "[reconstruct]\nalpha = 1e-3\n"},
      {Method::tikhonov, "[reconstruct]\nalpha = \"gcv\"\n"},
      {Method::tikhonov, "[reconstruct]\nalpha = 1e-3\nfriction_limit = 0.5\n"},
      {Method::closed_form, "[reconstruct]\nalpha = 1e-3\n"},
  }));
  CAPTURE(rest);
  const Scene scene = two_quantity_scene("[dead_taxels]\nindices = [9, 2]\n" + rest);
  const SceneProblem whole{scene};
  RecordingSolver incomplete(whole, method, {.missing = Missing::estimate});
  std::mt19937 draw(5);
  for (int round = 0; round < 6; ++round) {
    std::vector<double> readings = frame(draw);
    Scene with_dead = scene;
    for (const std::size_t taxel : {draw() % 8 + 9, draw() % 8 + 9}) {
      readings[taxel + (draw() % 2 == 0 ? 0 : taxel_count)] = missing_reading;
      with_dead.dead_taxels.push_back(taxel);
    }
    std::vector<double> complete = readings;
    for (double& one : complete)
      if (std::isnan(one)) one = 7.0;  // of a dead taxel: no matter

    std::vector<double> expected(2 * taxel_count);
    const auto result = incomplete.solve(readings);
    REQUIRE(result);
    const SceneProblem dead{with_dead};
    const FrameResult same = make_solver(dead, method)->solve(complete, expected);
    CHECK(result->tractions == expected);
    CHECK(result->solved == same.verdict);
    CHECK(result->alpha.value == same.alpha->value);
    // And the bands of either problem.
    const FrameUncertainty a = *with_bands(incomplete.problem(), readings, *result).bands;
    for (double& one : complete)
      if (one == 7.0) one = 0.0;
    const FrameUncertainty b = uncertainty({dead, complete}, expected, same);
    CHECK(a.deviation == b.deviation);
    CHECK(a.noise.residual_rms == b.noise.residual_rms);
  }
}

TEST_CASE("what patterns of missing taxels need is kept, not without end", "[lab][missing]") {
  std::size_t made = 0;
  PatternCache<std::size_t> patterns(10, 35);  // bytes of one, and of all
  const auto ask = [&](std::size_t taxel) {
    return patterns(std::vector{taxel}, [&] { return std::make_unique<std::size_t>(made++); });
  };
  const std::shared_ptr<std::size_t> first = ask(1);
  for (const std::size_t taxel : {2U, 3U, 1U, 2U}) (void)ask(taxel);
  CHECK(made == 3);
  CHECK(patterns.kept() == 3);
  (void)ask(4);  // in place of 3, which was asked for longest ago
  CHECK(patterns.kept() == patterns.most_kept());
  CHECK(ask(1) == first);
  (void)ask(3);
  CHECK(made == 5);
}

TEST_CASE("dft knows no dead taxels, and so none that are missing", "[lab][missing]") {
  const SceneProblem problem{
      parse_scene("[sensor]\ncount = 17\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
                  "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n",
                  "scene.toml")};
  CHECK_NOTHROW(RecordingSolver(problem, Method::dft));
  CHECK_THROWS_AS(RecordingSolver(problem, Method::dft, {.missing = Missing::estimate}),
                  std::invalid_argument);
}

TEST_CASE("policies go by their names", "[lab][missing]") {
  for (const Missing one : {Missing::fail, Missing::skip, Missing::estimate})
    CHECK(missing_named(name(one)) == one);
  CHECK_FALSE(missing_named("guess"));
}

TEST_CASE("frames that follow each other are one run, and runs are bounded", "[lab][missing]") {
  FrameRuns runs;
  for (const std::size_t one : {3u, 4u, 5u, 9u, 11u, 12u}) runs.add(one);
  REQUIRE(runs.runs().size() == 3);
  CHECK(runs.runs()[0].first == 3);
  CHECK(runs.runs()[0].last == 5);
  CHECK(runs.runs()[2].last == 12);
  CHECK(runs.count() == 6);
  CHECK(runs.not_listed() == 0);
  for (std::size_t one = 20; one < 10'000; one += 2) runs.add(one);
  CHECK(runs.runs().size() == FrameRuns::most_runs);
  CHECK(runs.count() == 6 + 4990);
  CHECK(runs.not_listed() == runs.count() - 6 - (FrameRuns::most_runs - 3));
}

}  // namespace tactile_net::lab
