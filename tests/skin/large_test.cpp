#include <cmath>
#include <optional>

#include "src/skin/large/lattice_products.hpp"
#include "src/skin/large/tiles.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/skin/large/cone.hpp"
#include "tactile_net/skin/large/family.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"
#include "tests/catch.hpp"
#include "tests/skin/large_skins.hpp"

using namespace tactile_net;

TEST_CASE("products by FFT are those of the matrix, both ways", "[skin][large]") {
  SkinArray mixed =
      square_skin(9, 2e-3, {Quantity::stress_x, Quantity::stress_y, Quantity::shear_yz});
  mixed.columns = 13;
  mixed.depths = {2e-3, 3e-3};
  for (const SkinArray& skin : {square_skin(8, 2e-3), square_skin(24, 2e-3), mixed})
    for (const Material& material : {silicone, thin})
      // Taxels on every cell, and on every other one.
      for (const double spacing : {1e-3, 0.5e-3}) {
        if (skin.rows == 24 && spacing < 1e-3) continue;
        const LinearProblem dense =
            make_problem(skin, material, with_dead({}, {.spacing = spacing}));
        const auto kernels = lattice_kernels(skin, material, dense.grid, 3);
        LatticeProducts products(skin, dense.grid, 3, kernels);
        const auto numbers = [](std::size_t count) {
          std::vector<double> all(count);
          for (std::size_t i = 0; i < count; ++i)
            all[i] = std::sin(1e3 * std::sin(static_cast<double>(i + 1)));
          return all;
        };
        CAPTURE(skin.rows, skin.columns, spacing, material.layer.has_value());
        double peak = 0.0;
        for (const double entry : dense.kernel.values) peak = std::max(peak, std::abs(entry));
        const auto tractions = numbers(dense.kernel.columns);
        std::vector<double> readings(dense.kernel.rows);
        products.readings(tractions, readings);
        const auto read = product(dense.kernel, tractions);
        for (std::size_t i = 0; i < read.size(); ++i)
          CHECK_THAT(readings[i], WithinAbs(read[i], 1e-12 * peak * norm(tractions)));

        const auto given = numbers(dense.kernel.rows);
        std::vector<double> sums(dense.kernel.columns);
        products.sums(given, sums);
        const auto expected = transposed_product(dense.kernel, given);
        for (std::size_t j = 0; j < expected.size(); ++j)
          CHECK_THAT(sums[j], WithinAbs(expected[j], 1e-12 * peak * norm(given)));
      }
}

namespace {

/// Odd and even sides, taxels on every cell and every other or third one, dead ones, other
/// readings, a layer, one traction a cell.
struct Skin {
  SkinArray array;
  Material material = silicone;
  SkinProblemOptions options{};
};
std::vector<Skin> small_skins() {
  SkinArray oblong =
      square_skin(9, 2e-3, {Quantity::stress_x, Quantity::stress_y, Quantity::shear_yz});
  oblong.columns = 6;
  oblong.depths = {2e-3, 3e-3};
  return {{square_skin(9, 2e-3)},
          {square_skin(8, 2e-3), thin},
          {square_skin(10, 2e-3), silicone, with_dead({0, 33, 34, 77})},
          {oblong, thin, with_dead({5, 20})},
          {square_skin(7, 2e-3), silicone, with_dead({3}, {.spacing = 0.5e-3})},
          {oblong, silicone, with_dead({}, {.spacing = 1e-3 / 3.0})},
          {square_skin(11, 2e-3, {Quantity::stress_x}), silicone, {.components = 1}}};
}

}  // namespace

TEST_CASE("a tile as large as the skin is the inverse of P", "[skin][large][tiles]") {
  for (const Skin& skin : small_skins()) {
    const auto system = make_large_skin_system(skin.array, skin.material, skin.options);
    const double alpha = 1e-4 * std::pow(uniform_readings(*system).pressure, 2);
    SkinTiles tiles(*system, alpha, {.cells = 100, .reach = 100});
    REQUIRE(tiles.tiles() == 1);
    const std::vector<double> x = random_numbers(system->tractions(), 1);
    std::vector<double> found(x.size());
    tiles.apply(normal_product(*system, alpha, x), found);
    CAPTURE(skin.array.rows, skin.array.columns, skin.options.dead_taxels.size());
    CHECK(distance(found, x) < 1e-9 * norm(x));
  }
}

TEST_CASE("the sum over tiles is symmetric and positive, and mirrors what the skin mirrors",
          "[skin][large][tiles]") {
  for (const Skin& skin : small_skins())
    for (const double share : {1e-2, 1e-8}) {
      const auto system = make_large_skin_system(skin.array, skin.material, skin.options);
      SkinTiles tiles(*system, share * std::pow(uniform_readings(*system).pressure, 2),
                      {.cells = 6});
      CHECK(tiles.tiles() > 1);
      const std::vector<double> x = random_numbers(system->tractions(), 2);
      const std::vector<double> y = random_numbers(system->tractions(), 3);
      std::vector<double> of_x(x.size());
      std::vector<double> of_y(y.size());
      tiles.apply(x, of_x);
      tiles.apply(y, of_y);
      CAPTURE(skin.array.rows, skin.array.columns, share, tiles.tiles(), tiles.kinds());
      CHECK_THAT(dot(x, of_y), WithinAbs(dot(of_x, y), 1e-9 * norm(x) * norm(of_y)));
      CHECK(dot(x, of_x) > 0.0);
      CHECK(dot(y, of_y) > 0.0);
      std::vector<double> again(x.size());
      tiles.apply(x, again);
      CHECK(again == of_x);

      if (!skin.options.dead_taxels.empty()) continue;
      const SurfaceGrid& grid = system->problem.grid;
      // Rows the other way round, q_y with the other sign.
      const auto mirrored = [&](std::span<const double> f) {
        std::vector<double> turned(f.size());
        for (std::size_t u = 0; u < system->problem.components; ++u)
          for (std::size_t m = 0; m < grid.rows; ++m)
            for (std::size_t n = 0; n < grid.columns; ++n)
              turned[(u * grid.rows + m) * grid.columns + n] =
                  (u == 1 ? -1.0 : 1.0) * f[(u * grid.rows + grid.rows - 1 - m) * grid.columns + n];
        return turned;
      };
      std::vector<double> of_mirrored(x.size());
      tiles.apply(mirrored(x), of_mirrored);
      CHECK(distance(of_mirrored, mirrored(of_x)) < 1e-9 * norm(of_x));
    }
}

TEST_CASE("steps of conjugate gradients hold at every alpha", "[skin][large][tiles]") {
  for (const Material& material : {silicone, thin}) check_steps(square_skin(24, 2e-3), material);
}

TEST_CASE("steps of conjugate gradients hold on a larger skin", "[skin][large][tiles][long]") {
  for (const Material& material : {silicone, thin}) check_steps(square_skin(40, 2e-3), material);
}

TEST_CASE("conjugate gradients reach the minimiser of the dense problem", "[skin][large]") {
  for (const Material& material : {silicone, thin})
    for (const auto& dead : {std::vector<std::size_t>{}, {0, 17, 18, 105, 190}})
      check_reaches_minimiser(square_skin(14, 2e-3), material, dead);
}

TEST_CASE("conjugate gradients reach the minimiser of a larger dense problem",
          "[skin][large][long]") {
  for (const Material& material : {silicone, thin})
    check_reaches_minimiser(square_skin(18, 2e-3), material, {0, 21, 22, 137, 310});
}

TEST_CASE("dead taxels cost conjugate gradients next to no steps", "[skin][large]") {
  const SkinArray skin = square_skin(24, 2e-3);
  LinearProblem dense = make_problem(skin, silicone);
  const double alpha = 1e-6 * size_of(make_problem(square_skin(12, 2e-3), silicone));
  const auto steps = [&](const SkinProblemOptions& options) {
    LargeSkinTikhonov solver(skin, silicone, options, alpha);
    const LinearProblem own = make_problem(skin, silicone, options);
    (void)solver.solve_normal(normal_right_side(own, readings_of(dense, 2)));
    return solver.convergence().steps;
  };
  const std::size_t whole = steps({});
  CHECK(steps(with_dead({30, 31, 55, 200, 300, 301, 302, 450})) <= whole + 5);
}

TEST_CASE("large skins of any shape are solved", "[skin][large]") {
  for (const auto& [rows, columns, spacing] :
       {std::tuple{1u, 30u, 1e-3}, {5u, 40u, 1e-3}, {9u, 17u, 0.5e-3}}) {
    SkinArray skin = square_skin(rows, 2e-3);
    skin.columns = columns;
    const SkinProblemOptions options = with_dead({}, {.spacing = spacing});
    const LinearProblem dense = make_problem(skin, silicone, options);
    const double alpha = 1e-4 * size_of(dense);
    LargeSkinTikhonov solver(skin, silicone, options, alpha);
    const auto right = normal_right_side(dense, readings_of(dense, 3));
    const auto x = solver.solve_normal(right);
    CAPTURE(rows, columns, solver.convergence().steps);
    CHECK(normal_residual(dense, alpha, x, right) < 2e-8);
  }
}

TEST_CASE("large skins whose cells reach far beyond their taxels are solved", "[skin][large]") {
  // Tiles of 16 cells, most of which no taxel is near.
  const SkinArray skin = square_skin(3, 1e-3);
  const SkinProblemOptions options = with_dead({}, {.margin = 26e-3});
  const double alpha = 1e-4 * size_of(make_problem(skin, silicone));
  LargeSkinSystem system(skin, silicone, options);
  std::vector<double> right(system.tractions());
  for (std::size_t i = 0; i < right.size(); ++i) right[i] = i % 7 == 3 ? 1.0 : -0.2;
  LargeSkinTikhonov solver(skin, silicone, options, alpha);
  const auto x = solver.solve_normal(right);
  CAPTURE(solver.convergence().steps);
  CHECK(distance(normal_product(system, alpha, x), right) < 2e-8 * norm(right));
}

TEST_CASE("alpha of a large skin is that of all singular values", "[skin][large]") {
  const SkinArray skin = square_skin(16, 2e-3);
  const LinearProblem dense = make_problem(skin, silicone);
  const TikhonovFamily family(dense);
  const double size = std::pow(family.singular_values().front(), 2);
  LargeSkinTikhonov solver(skin, silicone, {}, 1e-4 * size);
  const LargeSkinFamily large(solver);
  for (const double share : {1e-2, 1e-4, 1e-6}) {
    const double exact = family.degrees_of_freedom(share * size);
    CAPTURE(share, exact);
    CHECK_THAT(large.degrees_of_freedom(share * size),
               WithinAbs(exact, 4.0 * large.degrees_deviation(share * size) + 0.02 * exact));
  }
  std::mt19937 random(4);
  std::vector<double> readings = readings_of(dense, 5);
  const double noise = add_noise(readings, 0.01, random);
  const FilterFrame exact = family.analyse(readings);
  const FilterFrame quadrature = large.analyse(readings);
  CHECK(large.analyse(readings).powers == quadrature.powers);
  for (const AlphaRule rule :
       {AlphaRule::rgcv, AlphaRule::gcv, AlphaRule::aicc, AlphaRule::gml, AlphaRule::evidence}) {
    const double expected = choose_alone(exact, rule, noise).alpha;
    const double found = choose_alone(quadrature, rule, noise).alpha;
    CAPTURE(name(rule));
    CHECK_THAT(found, WithinRel(expected, 0.15));
    const auto of_expected = family.solve(exact, expected);
    const auto of_found = family.solve(exact, found);
    CHECK(distance(of_found, of_expected) < 0.03 * norm(of_expected));
  }
}

TEST_CASE("a large skin's cone is that of the dense problem", "[skin][large][cone]") {
  const SkinArray skin = square_skin(12, 2e-3);
  for (const double weight : {1.0, 3.0})
    for (const std::optional<double> limit :
         {std::optional<double>{}, std::optional(0.3), std::optional(0.8)}) {
      SkinProblemOptions options = with_dead({40, 41});
      options.tangential_weight = weight;
      const LinearProblem dense = make_problem(skin, silicone, options);
      const double alpha = 1e-4 * size_of(dense);
      const std::vector<double> readings = readings_of(dense, 7);
      const Constraints constraints{.friction_limit = limit};
      const ConeSolution expected =
          ConeTikhonov(dense, alpha, constraints).solve(readings, 20000, 1e-9);
      const LargeSkinCone cone(make_large_skin_system(skin, silicone, options), alpha, constraints);
      const ConeSolution found = cone.solve(readings, 20000, 1e-9);
      CAPTURE(weight, limit.value_or(0.0), found.iterations, found.residual);
      REQUIRE(found.status == FrameStatus::ok);
      CHECK(found.verdict == ConstrainedVerdict::ok);
      CHECK(distance(found.tractions, expected.tractions) < 1e-5 * norm(expected.tractions));
      CHECK(found.separation + found.slip + found.stick == dense.grid.count());
      CHECK(found.separation > 0);
      const std::size_t cells = dense.grid.count();
      for (std::size_t i = 0; i < cells; ++i) {
        const double p = found.tractions[i];
        const double q = std::hypot(found.tractions[cells + i], found.tractions[2 * cells + i]);
        CHECK(p >= 0.0);
        if (limit) CHECK(q <= *limit * p * (1.0 + 1e-12));
      }
      CHECK(cone.solve(readings, 20000, 1e-9).tractions == found.tractions);
    }
}

TEST_CASE("a large cone says where it stopped early, and refuses what it cannot take",
          "[skin][large][cone]") {
  const SkinArray skin = square_skin(8, 2e-3);
  const LinearProblem dense = make_problem(skin, silicone);
  const double alpha = 1e-5 * size_of(dense);
  const auto system = make_large_skin_system(skin, silicone, {});
  const LargeSkinCone cone(system, alpha, {.friction_limit = 0.5});
  const std::vector<double> readings = readings_of(dense, 8);
  const ConeSolution early = cone.solve(readings, 3);
  CHECK(early.verdict == ConstrainedVerdict::iteration_limit);
  CHECK(early.iterations == 3);
  CHECK(early.residual > 1e-6);
  const ConeSolution whole = cone.solve(readings);
  CHECK(whole.verdict == ConstrainedVerdict::ok);
  CHECK(whole.residual <= 1e-6);
  const ConeSolution explained = cone.solve(readings, 2000, 1e-6, 0.5 * norm(readings));
  CHECK(explained.verdict == ConstrainedVerdict::ok);
  CHECK(explained.iterations < whole.iterations);
  const ConeSolution nothing = cone.solve(std::vector<double>(readings.size()));
  CHECK(nothing.verdict == ConstrainedVerdict::ok);
  CHECK(nothing.separation == dense.grid.count());
  CHECK(norm(nothing.tractions) == 0.0);
  CHECK(cone.solve(std::vector<double>(5)).status == FrameStatus::wrong_size);
  CHECK(cone.solve(std::vector<double>(readings.size(), NAN)).status == FrameStatus::not_finite);
  CHECK_THROWS_WITH(LargeSkinCone(system, 0.0, {}), ContainsSubstring("alpha must be > 0"));
  CHECK_THROWS_WITH(LargeSkinCone(system, alpha, {.friction_limit = -1.0}),
                    ContainsSubstring("friction_limit must be > 0"));
}

TEST_CASE("what a large cone solved before changes no bit of what it solves next",
          "[skin][large][cone]") {
  const SkinArray skin = square_skin(8, 2e-3);
  const LinearProblem dense = make_problem(skin, silicone);
  const auto system = make_large_skin_system(skin, silicone, {});
  const double alpha = 1e-5 * size_of(dense);
  std::vector<std::vector<double>> frames;
  for (unsigned seed = 1; seed < 4; ++seed) frames.push_back(readings_of(dense, seed));
  frames.push_back(random_numbers(dense.kernel.rows, 4));  // of the sharpest waves
  const LargeSkinCone cone(system, alpha, {.friction_limit = 0.5});
  for (const auto& readings : frames) (void)cone.solve(readings, 200);
  for (const auto& readings : frames)
    CHECK(cone.solve(readings, 200).tractions ==
          LargeSkinCone(system, alpha, {.friction_limit = 0.5}).solve(readings, 200).tractions);
}

TEST_CASE("large skins refuse what FFT cannot multiply", "[skin][large]") {
  const SkinArray loose =
      uneven_skin({{"", 0.0, 0.0, 1e-3, press_and_drag}, {"", 1e-3, 0.3e-3, 1e-3, press_and_drag}});
  CHECK_THROWS_WITH(LargeSkinTikhonov(loose, silicone, {}, 1.0),
                    ContainsSubstring("must lie on the lattice"));
  CHECK_THROWS_WITH(
      LargeSkinTikhonov(square_skin(4, 1e-3), silicone, {.unknown_offsets = true}, 1.0),
      ContainsSubstring("unknown offset"));
  CHECK_THROWS_WITH(LargeSkinTikhonov(square_skin(4, 1e-3), silicone, {}, 0.0),
                    ContainsSubstring("alpha must be > 0"));
  LargeSkinTikhonov solver(square_skin(4, 2e-3), silicone, {}, 1.0);
  std::vector<double> f(3 * solver.problem().grid.count());
  CHECK(solver.solve(std::vector<double>(5), f) == FrameStatus::wrong_size);
  CHECK(solver.solve(std::vector<double>(48, NAN), f) == FrameStatus::not_finite);
  CHECK(solver.solve(std::vector<double>(48), f) == FrameStatus::ok);
}
