#include "tactile_net/skin/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tactile_net/skin/signal_layout.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

TEST_CASE("a problem's kernel times a load's cell means is what the forward model samples",
          "[skin][problem][property]") {
  const std::vector<SkinLoad> loads{SkinContact{
      .y = 0.4e-3, .z = -0.7e-3, .radius = 2e-3, .force = 0.3, .friction = 0.4, .direction = 1.0}};
  const double depth = GENERATE(2e-3, 0.4e-3);  // point loads, rectangles
  Material material{.youngs_modulus = 2e5, .poisson_ratio = 0.5};
  if (GENERATE(false, true)) material.layer = Layer{4e-3, Base::bonded};
  CAPTURE(depth, material.layer.has_value());
  SkinArray skin = square_skin(4, depth, {Quantity::stress_x, Quantity::shear_yz});
  SECTION("of a lattice") {}
  SECTION("of one row") { skin.rows = 1; }
  SECTION("of places anywhere") {
    skin = uneven_skin({{"a", -1e-3, 0.2e-3, depth, press_and_drag},
                        {"b", 1.1e-3, 0.9e-3, 1.5 * depth, {Quantity::stress_y}},
                        {"c", 0.3e-3, -2e-3, depth, press_and_drag}});
  }
  const LinearProblem problem = make_problem(skin, material);
  const std::vector<double> means = cell_means(loads, problem.grid);
  const std::vector<double> expected = sampled_readings(skin, material, problem.grid, means);
  CHECK(distance(product(problem.kernel, means), expected) <= 1e-13 * norm(expected));
}

TEST_CASE("a dead taxel's rows count for nothing, whether known before or after",
          "[skin][problem]") {
  const SkinArray skin = square_skin(4, 2e-3);
  LinearProblem later = make_problem(skin, silicone, {.channel_rms = {2.0, 1.0, 0.5}});
  const LinearProblem before =
      make_problem(skin, silicone, {.channel_rms = {2.0, 1.0, 0.5}, .dead_taxels = {5, 6}});
  leave_out(later, std::vector<std::size_t>{5, 6});
  CHECK(later.kernel.values == before.kernel.values);
  CHECK(later.weights == before.weights);
  CHECK(independent_readings(before) == 3 * 14);
  std::vector<double> readings(48, 1.0);
  CHECK(weighted(before, readings)[5] == 0.0);
  CHECK(weighted(before, readings)[4] == 0.5);
}

TEST_CASE("what a problem of a skin cannot be made of is refused with the rule",
          "[skin][problem]") {
  const SkinArray skin = square_skin(4, 2e-3);
  const auto refused = [&](const SkinProblemOptions& options, const std::string& rule) {
    CHECK_THROWS_WITH(make_problem(skin, silicone, options), ContainsSubstring(rule));
  };
  refused({.components = 2}, "components must be 1");
  refused({.smoothing_length = -1.0}, "smoothing_length");
  refused({.smoothing_length = std::numeric_limits<double>::quiet_NaN()}, "smoothing_length");
  refused({.tangential_weight = 0.0}, "tangential_weight");
  refused({.channel_rms = {1.0}}, "one value per channel");
  refused({.channel_rms = {1.0, 0.0, 1.0}}, "channel_rms must be > 0");
  refused({.dead_taxels = {16}}, "dead taxel 16 is not < 16");
  std::vector<std::size_t> all(16);
  for (std::size_t i = 0; i < 16; ++i) all[i] = i;
  refused({.dead_taxels = all}, "every taxel is dead");
  refused({.grid = {.spacing = 4e-6}}, "choose a");
  CHECK_THROWS_WITH(
      make_problem(square_skin(4, 2e-3, {Quantity::stress_x, Quantity::displacement_y}), silicone),
      ContainsSubstring("need channel_rms"));
  const Material slips{.poisson_ratio = 0.4, .layer = Layer{4e-3, Base::frictionless}};
  CHECK_THROWS_WITH(make_problem(square_skin(4, 2e-3, {Quantity::displacement_y}), slips),
                    ContainsSubstring("slides without end"));
  CHECK_NOTHROW(
      make_problem(square_skin(4, 2e-3, {Quantity::displacement_y}), slips, {.components = 1}));
  CHECK_THROWS_WITH(weighted(make_problem(skin, silicone), std::vector<double>(3)),
                    ContainsSubstring("3 values, the problem has 48"));
  CHECK_THROWS_WITH(normal_matrix(make_problem(skin, silicone), 0.0), ContainsSubstring("alpha"));
}

TEST_CASE("taxels anywhere have the pitch that a look at every pair of them finds",
          "[skin][problem]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (const double wide : {1.0, 1e-3, 0.0}) {
    std::vector<Taxel> taxels(40);
    for (Taxel& taxel : taxels)
      taxel = {"", place(random), wide * place(random), 1e-2, {Quantity::stress_x}};
    taxels.push_back(taxels.front());  // one place, another quantity
    taxels.back().reads = {Quantity::stress_y};
    const auto apart = [&](std::size_t i, std::size_t k) {
      return std::hypot(taxels[i].y - taxels[k].y, taxels[i].z - taxels[k].z);
    };
    double mean = 0.0;
    for (std::size_t i = 0; i < taxels.size(); ++i) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < taxels.size(); ++k)
        if (apart(i, k) > 0.0) nearest = std::min(nearest, apart(i, k));
      mean += nearest / static_cast<double>(taxels.size());
    }
    const SkinArray skin = uneven_skin(taxels);
    CHECK_THAT(skin.pitch_y, WithinRel(mean, 1e-12));
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < 40; ++i)
      for (std::size_t k = i + 1; k < 40; ++k)
        if (apart(i, k) <= 1.3 * skin.pitch_y) ++pairs;
    CHECK(signal_layout(skin).neighbours.size() == pairs);
  }
}
