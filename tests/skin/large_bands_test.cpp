#include <cmath>
#include <optional>

#include "src/skin/large/band_probes.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/skin/large/covariance.hpp"
#include "tactile_net/skin/large/family.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"
#include "tactile_net/skin/resultant.hpp"
#include "tests/catch.hpp"
#include "tests/skin/large_skins.hpp"

using namespace tactile_net;

TEST_CASE("bands of a large skin are those of its decomposition", "[skin][large]") {
  for (const double spacing : {1e-3, 0.5e-3}) {
    SkinArray skin = square_skin(20, 2e-3);
    skin.columns = 17;
    const SkinProblemOptions options =
        with_dead(spacing < 1e-3 ? std::vector<std::size_t>{} : std::vector<std::size_t>{50, 51},
                  {.spacing = spacing});
    if (spacing < 1e-3) skin.rows = 15;
    const LinearProblem dense = make_problem(skin, silicone, options);
    const TikhonovFamily family(dense);
    const double alpha = 1e-4 * std::pow(family.singular_values().front(), 2);
    LargeSkinTikhonov solver(skin, silicone, options, alpha);
    LargeSkinBands bands(solver, skin, silicone, options);
    for (const double prior : {alpha, 0.1 * alpha}) {
      const TractionCovariance exact(family, alpha, prior);
      const LargeSkinCovariance large(bands, prior, 1.0);
      const auto expected = exact.deviations();
      const auto found = large.deviations();
      const SurfaceGrid& grid = dense.grid;
      for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK_THAT(found[i], WithinRel(expected[i], 0.04));  // at dead taxels too
      const CellWindow window = window_of(grid, 2e-3);
      const auto summed = exact.window_deviations(grid, window);
      const auto guessed = large.window_deviations(grid, window);
      REQUIRE(guessed.size() == grid.count());
      for (std::size_t i = 0; i < summed.size(); ++i) {
        CHECK(guessed[i] > 0.95 * summed[i]);
        if (options.dead_taxels.empty()) CHECK_THAT(guessed[i], WithinRel(summed[i], 0.05));
      }
      std::vector<double> force(expected.size()), moment(expected.size());
      for (std::size_t i = 0; i < grid.count(); ++i) {
        force[i] = grid.area();
        moment[grid.count() + i] = grid.area() * grid.z(i % grid.columns);
        moment[i] = 0.3 * grid.area();
      }
      CHECK_THAT(large.deviation(force), WithinRel(exact.deviation(force), 1e-5));
      CHECK_THAT(large.covariance(force, moment), WithinRel(exact.covariance(force, moment), 1e-4));
    }
  }
}

TEST_CASE("bands of single cells are off by what is said of them", "[skin][large][long]") {
  const SkinArray skin = square_skin(20, 2e-3);
  for (const auto& dead : {std::vector<std::size_t>{}, std::vector<std::size_t>{41, 128, 189, 192},
                           std::vector<std::size_t>{205, 206, 225, 310, 311}}) {
    const SkinProblemOptions options = with_dead(dead);
    const LinearProblem dense = make_problem(skin, silicone, options);
    REQUIRE(dense.grid.count() == 24 * 24);
    const TikhonovFamily family(dense);
    const double size = std::pow(family.singular_values().front(), 2);
    for (const double share : {1e-2, 1e-4, 1e-6}) {
      LargeSkinTikhonov solver(skin, silicone, options, share * size);
      for (const double prior : {share * size, 0.1 * share * size}) {
        CAPTURE(dead.size(), share, prior / size);
        LargeSkinBands bands(solver, skin, silicone, options);
        const LargeSkinCovariance large(bands, prior, 1.0);
        const auto expected = TractionCovariance(family, share * size, prior).deviations();
        // What is solved for is the deviation itself.
        for (const BandProbe& probe : band_probes(dense)) {
          const std::vector<double> probed = probed_deviations(solver, prior, probe);
          for (std::size_t i = 0; i < probed.size(); ++i)
            CHECK_THAT(probed[i], WithinRel(expected[probe.tractions[i]], 0.02));
        }
        const BandError error = large.error();
        CHECK(error.tractions >= 5);
        CHECK(error.least <= error.most);
        const auto found = large.deviations();
        std::size_t beyond = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          const double off = found[i] / expected[i] - 1.0;
          if (off < error.least - 0.01 || off > error.most + 0.01) ++beyond;
          CHECK(std::abs(off) < (share < 1e-5 ? 0.1 : 0.025));
        }
        CHECK(beyond <= expected.size() / 40);
        // Of another skin whose dead taxels are others it is the same smaller one.
        const LargeSkinBands again(solver, bands);
        LargeSkinBands copied(solver, again);
        CHECK(LargeSkinCovariance(copied, prior, 1.0).deviations() == found);
      }
    }
  }
}

TEST_CASE("bands are wide in a block of dead taxels, and at its rim a sixth too narrow at most",
          "[skin][large]") {
  const SkinArray skin = square_skin(16, 2e-3);
  std::vector<std::size_t> block;
  for (std::size_t row = 4; row < 10; ++row)
    for (std::size_t column = 5; column < 11; ++column) block.push_back(16 * row + column);
  const SkinProblemOptions options = with_dead(block);
  const LinearProblem dense = make_problem(skin, silicone, options);
  const TikhonovFamily family(dense);
  const double alpha = 1e-4 * std::pow(family.singular_values().front(), 2);
  LargeSkinTikhonov solver(skin, silicone, options, alpha);
  LargeSkinBands bands(solver, skin, silicone, options);
  const auto found = LargeSkinCovariance(bands, alpha, 1.0).deviations();
  const auto expected = TractionCovariance(family, alpha, alpha).deviations();
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i] > 0.83 * expected[i]);
    CHECK(found[i] < 4.0 * expected[i]);
  }
}

TEST_CASE("probes of a skin serve it where a few taxels are dead", "[skin][large]") {
  const SkinArray skin = square_skin(24, 2e-3);
  const auto whole = make_large_skin_system(skin, silicone, {});
  const auto rest = without_taxels(*whole, {100, 250, 251, 400});
  const LargeSkinFamily probed(whole);
  const LargeSkinFamily taken(rest, probed);
  const LargeSkinFamily own(rest);
  for (const double alpha : {1e-2, 1e-4, 1e-6}) {
    const double exact = own.degrees_of_freedom(alpha);
    CHECK_THAT(taken.degrees_of_freedom(alpha),
               WithinAbs(exact, 0.01 * exact + 2.0 * own.degrees_deviation(alpha)));
  }
  const std::vector<double> readings =
      readings_of(make_problem(skin, silicone, with_dead({100, 250, 251, 400})), 3);
  CHECK(taken.analyse(readings).rows == own.analyse(readings).rows);
}

TEST_CASE("sums that follow from sums before need no solve, and have their deviations",
          "[skin][large]") {
  const SkinArray skin = square_skin(12, 2e-3);
  const LinearProblem dense = make_problem(skin, silicone);
  const TikhonovFamily family(dense);
  const double alpha = 1e-3 * size_of(dense);
  LargeSkinTikhonov solver(skin, silicone, {}, alpha);
  LargeSkinBands bands(solver, skin, silicone, {});
  const LargeSkinCovariance large(bands, 0.5 * alpha, 1.0);
  const TractionCovariance exact(family, alpha, 0.5 * alpha);
  const std::size_t cells = dense.grid.count();
  std::vector<double> press(3 * cells), drag(3 * cells), both(3 * cells);
  for (std::size_t i = 0; i < cells; i += 3) press[i] = drag[cells + i] = 1e-6;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = -2.0 * press[i] + 0.3 * drag[i];
  CHECK_THAT(large.deviation(press), WithinRel(exact.deviation(press), 1e-5));
  CHECK_THAT(large.deviation(drag), WithinRel(exact.deviation(drag), 1e-5));
  const std::size_t before = solver.convergence().steps;
  (void)solver.solve_normal(std::vector<double>(3 * cells, 0.0));  // leaves a mark
  REQUIRE(solver.convergence().steps == 0);
  CHECK_THAT(large.deviation(both), WithinRel(exact.deviation(both), 1e-5));
  CHECK_THAT(large.covariance(both, press), WithinRel(exact.covariance(both, press), 1e-4));
  CHECK(solver.convergence().steps == 0);
  CHECK(before > 0);
  // Weights of the size of an area's square hold no less.
  std::vector<double> tiny = press;
  for (double& weight : tiny) weight *= 1e-200;
  CHECK_THAT(large.deviation(tiny), WithinRel(1e-200 * exact.deviation(press), 1e-5));
  CHECK(large.deviation(std::vector<double>(3 * cells)) == 0.0);
}

TEST_CASE("bands of a large skin have the same bits whatever was asked for before",
          "[skin][large]") {
  const SkinArray skin = square_skin(8, 2e-3);
  const LinearProblem dense = make_problem(skin, silicone);
  const SurfaceGrid& grid = dense.grid;
  const double alpha = 1e-3 * size_of(dense);
  // Of a disc's cells: force, drag, moments, a centre, a torsion, and a sum that is none of these.
  std::vector<std::vector<double>> sums(6, std::vector<double>(3 * grid.count()));
  for (std::size_t cell = 0; cell < grid.count(); ++cell) {
    const double y = grid.y(cell / grid.columns);
    const double z = grid.z(cell % grid.columns);
    if (std::hypot(y, z) > 3e-3) continue;
    sums[0][cell] = sums[1][grid.count() + cell] = grid.area();
    sums[2][cell] = grid.area() * y;
    sums[3][cell] = y - 0.31e-3;
    sums[4][grid.count() + cell] = -z;
    sums[4][2 * grid.count() + cell] = y;
    sums[5][cell] = std::cos(1e4 * y);
  }
  const auto answers = [&](const std::vector<std::size_t>& order, bool at_other_alpha) {
    LargeSkinTikhonov solver(skin, silicone, {}, alpha);
    LargeSkinBands bands(solver, skin, silicone, {});
    if (at_other_alpha) {
      solver.use_alpha(1.3 * alpha);
      const LargeSkinCovariance other(bands, 0.9 * alpha, 1.0);
      (void)other.deviation(sums[3]);
      (void)other.error();
      solver.use_alpha(alpha);
    }
    const LargeSkinCovariance large(bands, 0.5 * alpha, 1.0);
    std::vector<double> all(sums.size());
    for (const std::size_t i : order) all[i] = large.deviation(sums[i]);
    if (at_other_alpha) solver.use_alpha(2.0 * alpha);  // a covariance keeps its own
    all.push_back(large.covariance(sums[0], sums[3]));
    all.push_back(large.error().least);
    all.push_back(large.error().most);
    return all;
  };
  const std::vector<double> forth = answers({0, 1, 2, 3, 4, 5}, false);
  CHECK(answers({5, 4, 3, 2, 1, 0}, false) == forth);
  CHECK(answers({2, 5, 0, 4, 1, 3}, true) == forth);
  const TractionCovariance exact(TikhonovFamily(dense), alpha, 0.5 * alpha);
  for (std::size_t i = 0; i < sums.size(); ++i)
    CHECK_THAT(forth[i], WithinRel(exact.deviation(sums[i]), 1e-5));
}
