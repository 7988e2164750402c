#include "tactile_net/skin/problem.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inverse/coordinates.hpp"
#include "inverse/mirror_classes.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/stabiliser.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

const SensorArray stress_array{21, 0.5, {1.5}, {Quantity::stress_x}};

}  // namespace

TEST_CASE("K times the tractions is the forward model", "[problem]") {
  const SensorArray several{17, 0.5, {1.0, 2.0}, {Quantity::stress_x, Quantity::stress_y}};
  const LinearProblem problem = make_problem(several, pad);
  const TractionField field{.normal = random_values(17, 1), .tangential = {}};
  const std::vector<double> readings = sampled_readings(several, pad, field);
  const Eigen::VectorXd product =
      view(problem.kernel) * Eigen::Map<const Eigen::VectorXd>(field.normal.data(), 17);
  REQUIRE(std::ssize(readings) == product.size());
  for (std::size_t i = 0; i < readings.size(); ++i)
    CHECK_THAT(product(static_cast<Eigen::Index>(i)), WithinAbs(readings[i], 1e-14));
}

TEST_CASE("P is symmetric, and positive definite by at least alpha", "[problem]") {
  const double alpha = GENERATE(1e-8, 1e-3, 10.0);
  for (const auto& [name, problem] : all_problems()) {
    CAPTURE(name, alpha);
    const Matrix p = normal_matrix(problem, alpha);
    const RowMajor dense = view(p);
    CHECK(dense == dense.transpose());
    const double smallest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly)
            .eigenvalues()(0);
    const double lighter = std::min(1.0, problem.tangential_weight);
    CHECK(smallest >= lighter * lighter * alpha * problem.measure - 1e-14 * dense.norm());
  }
}

TEST_CASE("P is the second derivative of the functional", "[problem]") {
  const double alpha = 1e-3;
  for (const auto& [name, problem] : all_problems()) {
    CAPTURE(name);
    const Matrix p = normal_matrix(problem, alpha);
    const std::vector<double> f = random_values(problem.kernel.columns, 2);
    const Eigen::Map<const Eigen::VectorXd> x(f.data(), std::ssize(f));
    const double functional =
        (view(problem.kernel) * x).squaredNorm() + alpha * smoothness(problem, f);
    CHECK_THAT(x.dot(view(p) * x), WithinRel(functional, 1e-13));
  }
}

TEST_CASE("the prior's deviation of a sum is by waves what it is by the stabiliser's inverse",
          "[problem]") {
  const double alpha = 1e-2;
  for (const auto& [name, problem] : all_problems()) {
    CAPTURE(name);
    const Matrix stabiliser = stabiliser_matrix(problem, alpha);
    const std::vector<double> sum = random_values(problem.kernel.columns, 6);
    const Eigen::Map<const Eigen::VectorXd> s(sum.data(), std::ssize(sum));
    const Eigen::VectorXd solved = Eigen::MatrixXd(view(stabiliser)).llt().solve(s);
    CHECK_THAT(prior_deviation(problem, sum, alpha), WithinRel(std::sqrt(s.dot(solved)), 1e-11));
    CHECK_THROWS_WITH(prior_deviation(problem, std::vector<double>{1.0}, alpha),
                      ContainsSubstring("needs one weight per traction"));
    // Where nothing is read the normal matrix is the stabiliser, entry by entry.
    LinearProblem blind = problem;
    std::fill(blind.kernel.values.begin(), blind.kernel.values.end(), 0.0);
    CHECK(normal_matrix(blind, alpha).values == stabiliser.values);
  }
}

TEST_CASE("without a smoothing length tractions are kept small, not smooth", "[problem]") {
  CHECK(make_problem(stress_array, pad).smoothing_length == 0.0);
}

TEST_CASE("an impossible problem is refused with its reason", "[problem]") {
  const auto refused = [&](const SensorArray& a, const LineProblemOptions& options,
                           const char* reason) {
    CHECK_THROWS_WITH(make_problem(a, pad, options), ContainsSubstring(reason));
  };
  refused(stress_array, {.smoothing_length = -1.0}, "smoothing_length must be >= 0");
  refused(stress_array, {.smoothing_length = std::nan("")}, "smoothing_length must be >= 0");
  refused(stress_array, {.channel_rms = {1.0, 2.0}}, "one value per channel");
  refused(stress_array, {.channel_rms = {0.0}}, "channel_rms must be > 0");
  refused(stress_array, {.dead_taxels = {21}}, "dead taxel 21 is not < 21");
  refused({2, 0.5, {1.5}, {Quantity::stress_x}}, {.dead_taxels = {0, 1}}, "every taxel is dead");
  refused({21, 0.5, {1.5}, {Quantity::stress_x, Quantity::strain_x}}, {}, "has no unit");
  CHECK_THROWS_AS(make_problem({1, 0.5, {1.5}, {Quantity::stress_x}}, pad), std::invalid_argument);
  CHECK_THROWS_AS(make_problem(stress_array, {1.0, 0.6}), std::invalid_argument);

  const LinearProblem problem = make_problem(stress_array, pad);
  CHECK_THROWS_AS(normal_matrix(problem, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(normal_matrix(problem, std::numeric_limits<double>::infinity()),
                  std::invalid_argument);
  CHECK_THROWS_AS(normal_right_side(problem, std::vector<double>(20)), std::invalid_argument);
}

TEST_CASE("a matrix that no memory should be asked for is refused before it is", "[problem]") {
  const SensorArray long_array{20000, 0.5, {1.5}, {Quantity::stress_x}};
  const LineProblemOptions hats{.surface = {.basis = SurfaceBasis::hats}};
  CHECK_THROWS_AS(make_problem(long_array, pad, hats), std::invalid_argument);
  CHECK_THROWS_WITH(make_problem(long_array, pad, hats), ContainsSubstring("20000 readings"));
}

TEST_CASE("a class has the same kernel whether its readings or its waves are taken first",
          "[problem][property]") {
  for (const auto& [name, problem] : all_problems()) {
    CAPTURE(name);
    const WaveCoordinates waves(problem, stabiliser_spectrum(problem).cwiseSqrt());
    const Eigen::MatrixXd all = waves.sums(as_eigen(problem.kernel).transpose());
    double squares = 0.0;
    for (const MirrorClass& part : mirror_classes(problem)) {
      const Eigen::MatrixXd folded =
          waves.sums_of(part.waves, folded_kernel(as_eigen(problem.kernel), part));
      const Eigen::MatrixXd selected = all(part.waves, Eigen::indexing::all);
      CHECK((folded - selected * part.readings.transpose()).norm() <= 1e-14 * all.norm());
      squares += folded.squaredNorm();
    }
    // No wave of a class shows in another's readings.
    CHECK_THAT(squares, WithinRel(all.squaredNorm(), 1e-12));
  }
}
