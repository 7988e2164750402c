#include "tactile_net/inverse/reconstruction.hpp"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/inverse/thesis/closed_form.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/traction_field.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/inverse/solutions.hpp"

using namespace tactile_net;

TEST_CASE("the answer solves P f = b, by a matrix or directly", "[tikhonov][property]") {
  const double alpha = GENERATE(1e-8, 1e-4, 1.0);
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name, alpha);
    const std::vector<double> g = random_values(problem.kernel.rows, 5);
    const Matrix p = normal_matrix(problem, alpha);
    const std::vector<double> b = normal_right_side(problem, g);
    for (const std::vector<double>& f :
         {solved(tikhonov(problem, alpha), g), tikhonov_solve(problem, alpha, g)})
      CHECK((view(p) * view(f) - view(b)).norm() <= 1e-12 * view(b).norm());
  }
}

TEST_CASE("the matrix loses kappa, not its square, of the readings' digits",
          "[tikhonov][closed_form]") {
  // Against the direct solve, which is backward stable, down to kappa = 1e10.
  const LinearProblem problem =
      make_problem({41, 0.25, {3.0}, {Quantity::stress_x, Quantity::shear_xy}}, {1.0, 0.5},
                   {.unknowns = 2, .smoothing_length = 3.0});
  const std::vector<double> smooth = [&] {
    std::vector<double> f(82);
    for (std::size_t i = 0; i < f.size(); ++i)
      f[i] = std::exp(-std::pow((static_cast<double>(i % 41) - 20.0) / 6.0, 2));
    const Eigen::VectorXd g = view(problem.kernel) * view(f);
    return std::vector<double>(g.begin(), g.end());
  }();
  const double alpha = GENERATE(1e-6, 1e-12, 1e-18, 1e-22);
  const std::vector<double> direct = tikhonov_solve(problem, alpha, smooth);
  for (const Reconstruction& inverse : {tikhonov(problem, alpha), closed_form(problem, alpha)}) {
    CAPTURE(alpha, inverse.condition());
    const double bound = forward_bound(problem, alpha, smooth, direct, inverse.condition());
    CHECK(relative_l2_error(solved(inverse, smooth), direct) <= bound);
    CHECK(relative_l2_error(solved(inverse, smooth), direct) <=
          1e-14 * inverse.condition() + 1e-13);
  }
}

TEST_CASE("two tractions are told apart by the pairs that determine them", "[tikhonov]") {
  using enum Quantity;
  const Contact contact = RigidContact{.half_width = 2.0, .force = 3.0, .friction = 0.4};
  const auto base = GENERATE(0, 1, 2);
  std::optional<Layer> layer;
  if (base > 0) layer = Layer{3.0, base == 1 ? Base::bonded : Base::frictionless};
  struct Pair {
    std::vector<double> depths;
    std::vector<Quantity> reads;
    double nu;
  };
  for (const Pair& pair :
       {Pair{{1.5}, {stress_x, shear_xy}, 0.5}, Pair{{1.5}, {stress_x, stress_y}, 0.45},
        Pair{{1.5}, {strain_x, strain_y}, 0.3}, Pair{{1.0, 1.5}, {stress_x}, 0.5},
        Pair{{1.0, 1.5}, {strain_x}, 0.5}}) {
    const SensorArray array{60, 0.25, pair.depths, pair.reads};
    const Material pad{1.0, pair.nu, layer};
    CAPTURE(base, pair.reads.size(), pair.nu, name(pair.reads.back()));
    const std::vector<double> g = exact_readings(array, pad, std::array{contact});
    const LinearProblem problem =
        make_problem(array, pad, {.unknowns = 2, .smoothing_length = 1.5});
    const std::vector<double> f = tikhonov_solve(problem, 1e-10, g);
    const TractionField truth = sample(std::array{contact}, array);
    CHECK(relative_l2_error(std::span(f).first(60), truth.normal) < 0.12);
    CHECK(relative_l2_error(std::span(f).last(60), truth.tangential) < 0.3);
    CHECK_THAT(sampled_force(std::span(f).first(60), 0.25), WithinRel(3.0, 0.02));
  }
}

TEST_CASE("any change of the answer raises the functional", "[tikhonov][property]") {
  const double alpha = 1e-3;
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    const std::vector<double> g = random_values(problem.kernel.rows, 6);
    const std::vector<double> f = solved(tikhonov(problem, alpha), g);
    const double least = functional_of(problem, alpha, g, f);
    for (unsigned seed = 10; seed < 30; ++seed) {
      std::vector<double> changed = f;
      const std::vector<double> step = random_values(f.size(), seed);
      for (std::size_t i = 0; i < f.size(); ++i) changed[i] += 1e-3 * step[i];
      CHECK(functional_of(problem, alpha, g, changed) > least);
    }
  }
}

TEST_CASE("the family's matrix is the same, and so is its condition", "[tikhonov][property]") {
  const double alpha = GENERATE(1e-6, 1e-3, 1.0);
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name, alpha);
    const Reconstruction expected = tikhonov(problem, alpha);
    const Reconstruction made = TikhonovFamily(problem).reconstruction(alpha);
    CHECK_THAT(made.condition(), WithinRel(expected.condition(), 1e-9));
    const auto a = view(made.transposed());
    const auto b = view(expected.transposed());
    CHECK((a - b).norm() <= 1e-13 * expected.condition() * b.norm());
  }
}

TEST_CASE("a cylinder's force comes back from exact readings", "[tikhonov]") {
  const SensorArray array{81, 0.25, {1.5}, {Quantity::stress_x}};
  const Material material{1.0, 0.45};
  const double center = GENERATE(0.0, 0.1, -2.6);
  const Contact contact = RigidContact{.center = center, .half_width = 2.0, .force = 3.0};
  const std::vector<double> g = exact_readings(array, material, std::array{contact});
  const std::vector<double> f =
      solved(tikhonov(make_problem(array, material, {.smoothing_length = 1.5}), 1e-4), g);
  CHECK_THAT(sampled_force(f, 0.25), WithinRel(3.0, 0.005));
}

TEST_CASE("an unusable matrix or alpha is refused", "[reconstruction]") {
  CHECK_THROWS_AS(Reconstruction({0, 0, {}}, 1.0), std::invalid_argument);
  CHECK_THROWS_AS(Reconstruction({1, 2, {1.0}}, 1.0), std::invalid_argument);
  CHECK_THROWS_AS(Reconstruction({1, 1, {std::nan("")}}, 1.0), std::invalid_argument);

  const LinearProblem problem = sample_problems().front().problem;
  for (const double alpha : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    CHECK_THROWS_AS(tikhonov(problem, alpha), std::invalid_argument);
    CHECK_THROWS_AS(closed_form(problem, alpha), std::invalid_argument);
    CHECK_THROWS_AS(tikhonov_solve(problem, alpha, random_values(81, 1)), std::invalid_argument);
  }
  CHECK_THROWS_AS(tikhonov_solve(problem, 1.0, random_values(80, 1)), std::invalid_argument);
  CHECK_THROWS_AS(tikhonov_solve(problem, 1.0, std::vector<double>(81, std::nan(""))),
                  std::invalid_argument);
}

TEST_CASE("what double precision cannot resolve is said to be rank deficient", "[tikhonov]") {
  const LinearProblem deep = make_problem({81, 0.25, {10.0}, {Quantity::stress_x}}, {1.0, 0.45},
                                          {.smoothing_length = 1.0});
  CHECK_THROWS_WITH(tikhonov(deep, 1e-40), ContainsSubstring("rank deficient in double precision"));
}

TEST_CASE("the condition number bounds what a change of the readings can do", "[tikhonov]") {
  const LinearProblem problem = sample_problems().front().problem;
  const Reconstruction strong = tikhonov(problem, 1e-2);
  const Reconstruction weak = tikhonov(problem, 1e-6);
  CHECK(strong.condition() >= 1.0);
  CHECK(weak.condition() > strong.condition());
}
