#include "tactile_net/inverse/thesis/closed_form.hpp"

#include <Eigen/Dense>
#include <array>

#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/inverse/solutions.hpp"

using namespace tactile_net;

TEST_CASE("the corrected closed form is the same minimiser by another way", "[closed_form]") {
  const double alpha = GENERATE(1e-6, 1e-4, 1e-3, 1.0);
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name, alpha);
    const std::vector<double> g = random_values(problem.kernel.rows, 7);
    CHECK(relative_l2_error(solved(closed_form(problem, alpha), g),
                            solved(tikhonov(problem, alpha), g)) <= 1e-10);
  }
}

TEST_CASE("the closed form without smoothing is the ridge solution", "[closed_form]") {
  const LinearProblem problem =
      make_problem({21, 0.5, {1.5}, {Quantity::stress_x}}, {1.0, 0.45}, {});
  const std::vector<double> g = random_values(21, 8);
  CHECK(relative_l2_error(solved(closed_form(problem, 1e-3), g),
                          solved(tikhonov(problem, 1e-3), g)) <= 1e-10);
}

TEST_CASE("the thesis' printed constant is not the minimum, its correction is", "[closed_form]") {
  // Example 4.1 by 4.12 and 4.15 as printed (without alpha d'u and alpha d'v, alpha for alpha N, d
  // as row sums) and as corrected, both from normal equations.
  const double alpha = 1e-3;
  const SensorArray array{81, 0.25, {1.5}, {Quantity::strain_x}};
  const Material material{1.0, 0.45};
  const LinearProblem problem = make_problem(array, material, {.smoothing_length = 1.0});
  const Contact cylinder = RigidContact{.half_width = 2.0};
  const std::vector<double> g = exact_readings(array, material, std::array{cylinder});

  const Eigen::Index n = 81;
  const Eigen::MatrixXd k = view(problem.kernel);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  sum.triangularView<Eigen::Lower>().setConstant(0.25);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
  const Eigen::MatrixXd kg = k * sum;
  const Eigen::LDLT<Eigen::MatrixXd> a(
      kg.transpose() * kg + alpha * (sum.transpose() * sum + Eigen::MatrixXd::Identity(n, n)));
  const Eigen::VectorXd b = k * ones;
  const auto objective = [&](const Eigen::VectorXd& d, bool corrected) {
    const Eigen::VectorXd u = a.solve(kg.transpose() * view(g));
    const Eigen::VectorXd v = a.solve(kg.transpose() * b + alpha * d);
    const double more = corrected ? 1.0 : 0.0;
    const double c =
        (b.dot(view(g)) - b.dot(kg * u) - more * alpha * d.dot(u)) /
        (b.dot(b) - b.dot(kg * v) + alpha * (corrected ? 81.0 : 1.0) - more * alpha * d.dot(v));
    const Eigen::VectorXd f = sum * (u - c * v) + c * ones;
    return functional_of(problem, alpha, g, {f.begin(), f.end()});
  };
  const double least = functional_of(problem, alpha, g, solved(tikhonov(problem, alpha), g));
  CHECK_THAT(objective(sum.transpose() * ones, true), WithinRel(least, 1e-9));
  CHECK(objective(sum * ones, false) > 1.2 * least);
}
