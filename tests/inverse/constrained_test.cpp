#include "tactile_net/inverse/constrained.hpp"

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/traction_field.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

const SensorArray array_of_both{31, 0.5, {1.0}, {Quantity::stress_x, Quantity::shear_xy}};

LinearProblem problem_of_both() {
  return make_problem(array_of_both, pad, {.unknowns = 2, .smoothing_length = 1.0});
}

/// A sliding cylinder, with noise.
std::vector<double> dragged(double noise) {
  const Contact contact = RigidContact{.center = 1.0, .half_width = 2.5, .friction = 0.3};
  std::vector<double> g = exact_readings(array_of_both, pad, std::array{contact});
  add_noise(g, noise, 4, 0);
  return g;
}

}  // namespace

TEST_CASE("the constraints hold, and the rest is optimal", "[constrained][property]") {
  const double alpha = GENERATE(1e-9, 1e-6, 1e-3, 1.0);
  const double limit = GENERATE(0.05, 0.3, 0.8, 1e6);
  const LinearProblem problem = problem_of_both();
  const Constraints constraints{.friction_limit = limit};
  const bool random = GENERATE(false, true);
  const std::vector<double> g = random ? random_values(62, 12) : dragged(1e-3);
  const ConstrainedSolution solution = ConstrainedTikhonov(problem, alpha, constraints).solve(g);
  CAPTURE(alpha, limit, random);
  REQUIRE(solution.verdict == ConstrainedVerdict::ok);
  CHECK(solution.kkt_residual < 1e-9);
  if (!random && alpha >= 1e-3 && limit == 0.8) CHECK(solution.iterations <= 12);  // by blocks
  for (std::size_t i = 0; i < 31; ++i) {
    CHECK(solution.tractions[i] >= 0.0);
    CHECK(std::abs(solution.tractions[31 + i]) <=
          limit * solution.tractions[i] * (1.0 + 1e-12) + 1e-15);
  }
  // Optimality without the solver's words: the gradient P f - b is a normal of the cone at f, so
  // that it lies in the dual cone and is orthogonal to f.
  const Eigen::VectorXd gradient = view(normal_matrix(problem, alpha)) * view(solution.tractions) -
                                   view(normal_right_side(problem, g));
  Eigen::VectorXd along(62);  // the cone's edges
  along << gradient.head(31) + limit * gradient.tail(31),
      gradient.head(31) - limit * gradient.tail(31);
  const double size = view(normal_right_side(problem, g)).norm() * (1.0 + limit);
  CHECK(along.minCoeff() >= -1e-9 * size);
  CHECK(std::abs(gradient.dot(view(solution.tractions))) <=
        1e-9 * size * view(solution.tractions).norm());
}

TEST_CASE("constraints that do not bind change nothing", "[constrained]") {
  const LinearProblem problem = problem_of_both();
  std::vector<double> f(62, 1.0);  // everywhere inside the cone
  for (std::size_t i = 31; i < 62; ++i) f[i] = 0.1;
  const Eigen::VectorXd readings = view(problem.kernel) * view(f);
  const std::vector<double> g(readings.begin(), readings.end());
  const ConstrainedSolution solution =
      ConstrainedTikhonov(problem, 1e-6, {.friction_limit = 0.8}).solve(g);
  CHECK(solution.free.size() == 62);
  CHECK(relative_l2_error(solution.tractions, tikhonov_solve(problem, 1e-6, g)) < 1e-10);
}

TEST_CASE("a normal traction alone is kept from pulling", "[constrained]") {
  const SensorArray array{31, 0.5, {1.0}, {Quantity::stress_x}};
  const LinearProblem problem = make_problem(array, pad, {.smoothing_length = 1.0});
  const Contact contact = RigidContact{.half_width = 2.0};
  std::vector<double> g = exact_readings(array, pad, std::array{contact});
  add_noise(g, 5e-3, 3, 0);
  const std::vector<double> truth = sample(std::array{contact}, array).normal;
  const ConstrainedSolution solution = ConstrainedTikhonov(problem, 1e-5, {}).solve(g);
  for (const double f : solution.tractions) CHECK(f >= 0.0);
  CHECK(relative_l2_error(solution.tractions, truth) <
        relative_l2_error(tikhonov_solve(problem, 1e-5, g), truth));
}

TEST_CASE("nonnegative leaves the tangential traction free", "[constrained]") {
  const ConstrainedSolution solution =
      ConstrainedTikhonov(problem_of_both(), 1e-5, {}).solve(dragged(1e-2));
  double least = 0.0;
  for (std::size_t i = 0; i < 31; ++i) {
    CHECK(solution.tractions[i] >= 0.0);
    least = std::min(least, solution.tractions[31 + i]);
  }
  CHECK(least < 0.0);
}

TEST_CASE("one row of frames and its mirror image have mirrored answers", "[constrained]") {
  std::vector<double> g = dragged(1e-3);
  std::vector<double> mirrored = g;
  for (std::size_t i = 0; i < 31; ++i) {
    mirrored[i] = g[30 - i];
    mirrored[31 + i] = -g[61 - i];
  }
  const ConstrainedTikhonov inverse(problem_of_both(), 1e-6, {.friction_limit = 0.8});
  const std::vector<double> f = inverse.solve(g).tractions;
  std::vector<double> back = inverse.solve(mirrored).tractions;
  std::reverse(back.begin(), back.begin() + 31);
  std::reverse(back.begin() + 31, back.end());
  for (std::size_t i = 31; i < 62; ++i) back[i] = -back[i];
  CHECK(relative_l2_error(back, f) < 1e-10);
}

TEST_CASE("a limit on iterations is a verdict, not a hang", "[constrained]") {
  const ConstrainedTikhonov inverse(problem_of_both(), 1e-9, {.friction_limit = 0.1});
  for (const std::size_t limit : {std::size_t{1}, std::size_t{2}, std::size_t{8}}) {
    const ConstrainedSolution solution = inverse.solve(random_values(62, 12), limit);
    CHECK(solution.verdict == ConstrainedVerdict::iteration_limit);
    for (std::size_t i = 0; i < 31; ++i) {
      CHECK(solution.tractions[i] >= 0.0);
      CHECK(std::abs(solution.tractions[31 + i]) <= 0.1 * solution.tractions[i] + 1e-15);
    }
  }
}

TEST_CASE("zero, tiny and huge frames are solved like others", "[constrained]") {
  const ConstrainedTikhonov inverse(problem_of_both(), 1e-6, {.friction_limit = 0.8});
  for (const double f : inverse.solve(std::vector<double>(62)).tractions) CHECK(f == 0.0);
  const std::vector<double> g = dragged(1e-3);
  const std::vector<double> f = inverse.solve(g).tractions;
  for (const double scale : {1e-150, 1e150}) {
    std::vector<double> scaled = g;
    for (double& value : scaled) value *= scale;
    std::vector<double> answer = inverse.solve(scaled).tractions;
    for (double& value : answer) value /= scale;
    CHECK(relative_l2_error(answer, f) < 1e-10);
  }
}

TEST_CASE("what cannot be asked is refused", "[constrained]") {
  const LinearProblem one =
      make_problem({31, 0.5, {1.0}, {Quantity::stress_x}}, pad, {.smoothing_length = 1.0});
  CHECK_THROWS_AS(ConstrainedTikhonov(one, 1e-3, {.friction_limit = 0.5}), std::invalid_argument);
  const LinearProblem two = problem_of_both();
  CHECK_THROWS_AS(ConstrainedTikhonov(two, 1e-3, {.friction_limit = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(ConstrainedTikhonov(two, 0.0, {}), std::invalid_argument);
  CHECK(ConstrainedTikhonov(two, 1e-3, {}).solve(std::vector<double>(31)).status ==
        FrameStatus::wrong_size);
}
