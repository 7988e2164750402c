// Channels whose readings have a constant that nobody knows.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

/// Of a sphere, with noise of a thousandth.
std::vector<double> readings_of(const SkinArray& skin) {
  const std::vector<SkinLoad> loads{SkinContact{
      .y = 0.4e-3, .z = -0.7e-3, .radius = 2e-3, .force = 0.3, .friction = 0.4, .direction = 1.0}};
  std::vector<double> readings = exact_readings(skin, silicone, loads);
  std::mt19937 random(11);
  std::normal_distribution<double> value(0.0, 1e-3 * norm(readings));
  for (double& reading : readings) reading += value(random);
  return readings;
}

std::vector<double> with_offsets(std::vector<double> readings, const SkinArray& skin,
                                 const std::vector<double>& offsets) {
  for (std::size_t i = 0; const Site& site : sites(skin)) readings[i++] += offsets[site.channel];
  return readings;
}

std::vector<double> solved(const LinearProblem& problem, const std::vector<double>& readings,
                           double alpha) {
  const TikhonovFamily family(problem);
  return family.solve(family.analyse(readings), alpha);
}

}  // namespace

TEST_CASE("what a channel's readings are off by together moves no traction", "[skin][offset]") {
  SkinArray skin = square_skin(5, 2e-3);
  SECTION("of a lattice, in four classes") {}
  SECTION("of places anywhere, in one") {
    skin = uneven_skin({{"a", -1e-3, 0.2e-3, 2e-3, press_and_drag},
                        {"b", 1.1e-3, 0.9e-3, 3e-3, {Quantity::stress_x}},
                        {"c", 2.1e-3, -0.4e-3, 2e-3, press_and_drag},
                        {"d", 0.3e-3, -2e-3, 2e-3, press_and_drag}});
  }
  const LinearProblem problem = make_problem(skin, silicone, {.unknown_offsets = true});
  const std::vector<double> readings = readings_of(skin);
  const double size = norm(readings);
  const std::vector<double> off{size, -2.0 * size, 0.5 * size};
  const std::vector<double> moved = with_offsets(readings, skin, off);
  const double alpha = 1e-4 * std::pow(norm(problem.kernel.values), 2);

  const std::vector<double> f = solved(problem, readings, alpha);
  const std::vector<double> g = solved(problem, moved, alpha);
  CHECK(norm(f) > 0.0);
  CHECK(distance(f, g) <= 1e-10 * norm(f));
  // And what they are off by is found, to where it would be without.
  const std::vector<double> before = offsets(problem, readings, f);
  const std::vector<double> after = offsets(problem, moved, g);
  for (std::size_t c = 0; c < 3; ++c)
    CHECK_THAT(after[c] - before[c], WithinAbs(off[c], 1e-10 * size));
  CHECK(offsets(make_problem(skin, silicone), readings, f).empty());

  // The least of both, tractions and offsets: the residual of every channel adds up to nothing,
  // and with the offsets taken out nothing else explains the readings better.
  const LinearProblem plain = make_problem(skin, silicone);
  std::vector<double> minus(before.size());
  std::transform(before.begin(), before.end(), minus.begin(), [](double x) { return -x; });
  const std::vector<double> rest = with_offsets(readings, skin, minus);
  const std::vector<double> explained = product(plain.kernel, f);
  std::vector<double> sums(3);
  for (std::size_t i = 0; const Site& site : plain.sites) {
    sums[site.channel] += explained[i] - rest[i];
    ++i;
  }
  CHECK(norm(sums) <= 1e-10 * size);
  const std::vector<double> left = product(normal_matrix(plain, alpha), f);
  const std::vector<double> right = normal_right_side(plain, rest);
  CHECK(distance(left, right) <= 1e-8 * norm(right));
}

TEST_CASE("every other map of readings knows the offsets", "[skin][offset]") {
  const SkinArray skin = square_skin(4, 2e-3);
  const LinearProblem problem =
      make_problem(skin, silicone,
                   {.channel_rms = {2.0, 1.0, 0.5}, .dead_taxels = {5}, .unknown_offsets = true});
  CHECK(independent_readings(problem) == 3 * 15 - 3);
  const std::vector<double> readings = readings_of(skin);
  const std::vector<double> moved = with_offsets(readings, skin, {1e3, -2e3, 5e2});
  const double alpha = 1e-4 * std::pow(norm(problem.kernel.values), 2);
  const TikhonovFamily family(problem);
  const std::vector<double> f = solved(problem, readings, alpha);
  std::vector<double> mapped(f.size());
  REQUIRE(family.reconstruction(alpha).solve(moved, mapped) == FrameStatus::ok);
  CHECK(distance(mapped, f) <= 1e-9 * norm(f));
  const ConeTikhonov cone(problem, alpha, Constraints{.friction_limit = 0.8});
  const auto a = cone.solve(readings);
  const auto b = cone.solve(moved);
  REQUIRE(a.verdict == ConstrainedVerdict::ok);
  REQUIRE(b.verdict == ConstrainedVerdict::ok);
  CHECK(distance(a.tractions, b.tractions) <= 1e-3 * norm(a.tractions));
  CHECK(distance(weighted(problem, readings), weighted(problem, moved)) <=
        1e-10 * norm(weighted(problem, readings)));
}

TEST_CASE("taxels left out later are as if they had been dead, offsets or not", "[skin][offset]") {
  const SkinArray skin = square_skin(4, 2e-3);
  LinearProblem later = make_problem(skin, silicone, {.unknown_offsets = true});
  const LinearProblem before =
      make_problem(skin, silicone, {.dead_taxels = {5, 6, 11}, .unknown_offsets = true});
  leave_out(later, std::vector<std::size_t>{5, 6});
  leave_out(later, std::vector<std::size_t>{5, 6, 11});
  CHECK(distance(later.kernel.values, before.kernel.values) <= 1e-13 * norm(before.kernel.values));
  CHECK(distance(later.constants.values, before.constants.values) <=
        1e-13 * norm(before.constants.values));
  CHECK(later.weights == before.weights);
}

TEST_CASE("an unknown offset takes one reading a channel", "[skin][offset]") {
  SkinArray one = square_skin(1, 2e-3);
  CHECK(is_measured(one, {}, false));
  CHECK_FALSE(is_measured(one, {}, true));
  CHECK_THROWS_WITH(make_problem(one, silicone, {.unknown_offsets = true}),
                    ContainsSubstring("no channel has two living taxels"));
  const SkinArray two = square_skin(2, 2e-3);
  CHECK(is_measured(two, std::vector<std::size_t>{0, 1}, true));
  CHECK_FALSE(is_measured(two, std::vector<std::size_t>{0, 1, 2}, true));
}
