#include "tactile_net/lab/missing.hpp"

#include <cmath>
#include <random>

#include "tactile_net/lab/frame_runs.hpp"
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
  IncompleteFrames incomplete(whole, method);
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

    std::vector<double> found(2 * taxel_count), expected(2 * taxel_count);
    const auto result = incomplete.solve(readings, found);
    REQUIRE(result);
    const SceneProblem dead{with_dead};
    const FrameResult same = make_solver(dead, method)->solve(complete, expected);
    CHECK(found == expected);
    CHECK(result->verdict == same.verdict);
    CHECK(result->alpha->value == same.alpha->value);
    // And the bands of either problem.
    const FrameUncertainty a = uncertainty({incomplete.problem(), readings}, found, *result);
    for (double& one : complete)
      if (one == 7.0) one = 0.0;
    const FrameUncertainty b = uncertainty({dead, complete}, expected, same);
    CHECK(a.deviation == b.deviation);
    CHECK(a.noise.residual_rms == b.noise.residual_rms);
  }
}

TEST_CASE("patterns of missing taxels are kept, not without end", "[lab][missing]") {
  IncompleteFrames incomplete(SceneProblem{two_quantity_scene("[reconstruct]\nalpha = 1e-3\n")},
                              Method::tikhonov);
  std::mt19937 draw(5);
  std::vector<double> found(2 * taxel_count);
  const auto solve = [&](std::size_t pattern) {
    std::vector<double> readings = frame(draw);
    for (std::size_t bit = 0; bit < taxel_count; ++bit)
      if ((pattern >> bit & 1) != 0) readings[bit] = missing_reading;
    return incomplete.solve(readings, found).has_value();
  };
  for (std::size_t pattern = 1; pattern <= 20; ++pattern)
    for (int again = 0; again < 2; ++again) CHECK(solve(pattern));
  CHECK(incomplete.kept() == 20);
  CHECK(incomplete.most_kept() < 1000);
  CHECK(incomplete.most_kept() > 20);
  for (std::size_t pattern = 1; pattern <= incomplete.most_kept() + 5; ++pattern)
    (void)solve(pattern);
  CHECK(incomplete.kept() == incomplete.most_kept());
  CHECK_FALSE(solve((std::size_t{1} << taxel_count) - 1));  // nothing is left
}

TEST_CASE("dft knows no dead taxels, and so none that are missing", "[lab][missing]") {
  CHECK_THROWS_AS(IncompleteFrames(SceneProblem{two_quantity_scene("")}, Method::dft),
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
