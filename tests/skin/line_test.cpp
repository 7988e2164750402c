// A line's problem is one of a grid of one column: what solves skins solves it, too.
#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/skin/covariance.hpp"
#include "tactile_net/skin/family.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

std::vector<double> descending(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  return sorted;
}

}  // namespace

TEST_CASE(
    "a line is a skin of one column: mirror classes in waves find what the stacked matrix does",
    "[skin][family][line]") {
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    const TikhonovFamily line(problem);
    const SkinFamily skin(problem);
    std::vector<double> of_line = descending(line.singular_values());
    std::vector<double> of_skin = descending(skin.singular_values());
    // What one of them leaves out is 0 in the other.
    const std::size_t count = std::max(of_line.size(), of_skin.size());
    of_line.resize(count);
    of_skin.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      CHECK_THAT(of_skin[i], WithinAbs(of_line[i], 1e-12 * of_line[0]));

    const double alpha = 1e-3 * of_line[0] * of_line[0];
    const std::vector<double> readings = random_values(problem.weights.size(), 5);
    const std::vector<double> f = line.solve(line.analyse(readings), alpha);
    CHECK(relative_l2_error(skin.solve(skin.analyse(readings), alpha), f) <= 1e-11);
    CHECK(relative_l2_error(SkinCovariance(skin, alpha, 0.5 * alpha).deviations(),
                            TractionCovariance(line, alpha, 0.5 * alpha).deviations()) <= 1e-11);
  }
}

TEST_CASE("methods for lines refuse a skin's problem", "[skin][line]") {
  const LinearProblem problem = make_problem(square_skin(3, 2e-3), silicone, {.components = 1});
  const auto refuses = [](const std::function<void()>& call) {
    CHECK_THROWS_WITH(call(), ContainsSubstring("this method is for lines"));
  };
  refuses([&] { (void)tikhonov(problem, 1e-3); });
  refuses([&] { const TikhonovFamily family(problem); });
  refuses([&] { const ConstrainedTikhonov cone(problem, 1e-3, {.nonnegative = true}); });
  refuses([&] { (void)identifiability(problem); });
}
