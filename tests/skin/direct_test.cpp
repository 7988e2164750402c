// One frame by a QR of everything: against the functional itself, and against the classes.
#include <limits>
#include <stdexcept>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

constexpr Material firm_silicone{.youngs_modulus = 0.25e6, .poisson_ratio = 0.48};
constexpr double direct_alpha = 1e-4;

LinearProblem problem_of(std::size_t rows, std::size_t columns, const SkinProblemOptions& options) {
  return make_problem({.rows = rows,
                       .columns = columns,
                       .pitch_y = 2e-3,
                       .pitch_z = 3e-3,
                       .depths = {3e-3},
                       .reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz}},
                      firm_silicone, options);
}

/// Fewer readings than tractions, more, a dead taxel, offsets that are not known.
std::vector<LinearProblem> small_problems() {
  return {problem_of(4, 5, {}), problem_of(5, 4, {.components = 1, .grid = {.margin = 0.0}}),
          problem_of(3, 4, {.dead_taxels = {5}, .grid = {.margin = 0.0}}),
          problem_of(4, 4, {.tangential_weight = 2.0, .unknown_offsets = true})};
}

/// P f - b over b.
double gradient(const LinearProblem& problem, const std::vector<double>& readings,
                const std::vector<double>& f) {
  const Matrix matrix = normal_matrix(problem, direct_alpha);
  const std::vector<double> right = normal_right_side(problem, readings);
  std::vector<double> left(right.size());
  for (std::size_t i = 0; i < right.size(); ++i)
    for (std::size_t j = 0; j < f.size(); ++j) left[i] += matrix(i, j) * f[j];
  return relative_l2_error(left, right);
}

}  // namespace

TEST_CASE("the frame by a QR satisfies the normal equations, and is the classes' answer",
          "[skin][direct]") {
  for (const LinearProblem& problem : small_problems()) {
    CAPTURE(problem.kernel.rows, problem.kernel.columns);
    const std::vector<double> readings = random_numbers(problem.weights.size(), 3);
    const std::vector<double> f = tikhonov_solve(problem, direct_alpha, readings);
    CHECK(gradient(problem, readings, f) < 1e-10);
    const TikhonovFamily family(problem);
    CHECK(relative_l2_error(family.solve(family.analyse(readings), direct_alpha), f) < 1e-11);
  }
}

TEST_CASE("one frame by a QR: bad input is refused", "[skin][direct]") {
  const LinearProblem problem = problem_of(3, 3, {});
  std::vector<double> readings = random_numbers(problem.weights.size(), 3);
  CHECK_THROWS_AS(tikhonov_solve(problem, 0.0, readings), std::invalid_argument);
  CHECK_THROWS_AS(tikhonov_solve(problem, direct_alpha, std::vector<double>(2)),
                  std::invalid_argument);
  readings[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(tikhonov_solve(problem, direct_alpha, readings), std::invalid_argument);
}
