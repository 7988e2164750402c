// What is for lines alone.
#include <functional>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/load_windows.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

/// A skin whose grid is one column of cells, as wide as a line's.
LinearProblem strip() {
  return make_problem({.rows = 6,
                       .columns = 1,
                       .pitch_y = 1.0,
                       .pitch_z = 1.0,
                       .depths = {2.0},
                       .reads = {Quantity::stress_x}},
                      silicone, {.components = 1, .grid = {.spacing = 1.0, .margin = 0.0}});
}

}  // namespace

TEST_CASE("methods for lines refuse a skin's problem", "[skin][line]") {
  for (const LinearProblem& problem :
       {make_problem(square_skin(3, 2e-3), silicone, {.components = 1}), strip()}) {
    const auto refuses = [](const std::function<void()>& call) {
      CHECK_THROWS_WITH(call(), ContainsSubstring("this method is for lines"));
    };
    refuses([&] { (void)tikhonov(problem, 1e-3); });
    refuses([&] { const LoadWindows windows(problem, 1e-3); });
    refuses([&] { const ConstrainedTikhonov cone(problem, 1e-3, {.nonnegative = true}); });
    refuses([&] { (void)identifiability(problem); });
  }
}

TEST_CASE("a skin of one column is solved as any skin", "[skin][line]") {
  const LinearProblem problem = strip();
  REQUIRE(problem.grid.columns == 1);
  const std::vector<double> readings = random_numbers(problem.sites.size(), 3);
  const TikhonovFamily family(problem);
  const FilterFrame frame = family.analyse(readings);
  CHECK(frame.periodogram == nullptr);
  CHECK(relative_l2_error(family.solve(frame, 1e-3), tikhonov_solve(problem, 1e-3, readings)) <
        1e-10);
}
