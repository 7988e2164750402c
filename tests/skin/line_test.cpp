// What is for lines alone.
#include <functional>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/load_windows.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

TEST_CASE("methods for lines refuse a skin's problem", "[skin][line]") {
  const LinearProblem problem = make_problem(square_skin(3, 2e-3), silicone, {.components = 1});
  const auto refuses = [](const std::function<void()>& call) {
    CHECK_THROWS_WITH(call(), ContainsSubstring("this method is for lines"));
  };
  refuses([&] { (void)tikhonov(problem, 1e-3); });
  refuses([&] { const LoadWindows windows(problem, 1e-3); });
  refuses([&] { const ConstrainedTikhonov cone(problem, 1e-3, {.nonnegative = true}); });
  refuses([&] { (void)identifiability(problem); });
}
