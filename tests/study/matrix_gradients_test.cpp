// Conjugate gradients with the matrix of a skin, against a QR of everything.
#include "study/matrix_gradients.hpp"

#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/control/skins.hpp"

using namespace tactile_net;
using namespace tactile_net::study;

namespace {

constexpr double gradients_alpha = 1e-4;

}  // namespace

TEST_CASE("conjugate gradients with the matrix come nearer with every step, and end at the answer",
          "[skin][gradients]") {
  const Skin offsets = skin_of("offsets",
                               {.rows = 4,
                                .columns = 4,
                                .pitch_y = 2e-3,
                                .pitch_z = 3e-3,
                                .depths = {3e-3},
                                .reads = three_stresses},
                               {.tangential_weight = 2.0, .unknown_offsets = true});
  for (const Skin& skin : {rectangle(4, 5), square(4, 1), rectangle(3, 4, {5}), offsets}) {
    CAPTURE(skin.name);
    const LinearProblem& problem = skin.problem;
    const std::vector<double> readings = frame_of(problem, 3);
    const std::vector<double> exact = tikhonov_solve(problem, gradients_alpha, readings);
    const SkinMatrixGradients inverse(problem, gradients_alpha);
    const Matrix matrix = normal_matrix(problem, gradients_alpha);
    const auto energy = [&](const std::vector<double>& f) {  // of the error, in P's norm
      double sum = 0.0;
      for (std::size_t i = 0; i < f.size(); ++i)
        for (std::size_t j = 0; j < f.size(); ++j)
          sum += (f[i] - exact[i]) * matrix(i, j) * (f[j] - exact[j]);
      return sum;
    };
    std::vector<double> f(exact.size());
    double before = energy(f);
    for (const std::size_t steps : {1U, 2U, 4U, 8U, 16U}) {
      CAPTURE(steps);
      REQUIRE(inverse.solve(readings, f, steps) == FrameStatus::ok);
      const double now = energy(f);
      CHECK(now < before);
      before = now;
    }
    REQUIRE(inverse.solve(readings, f, 400) == FrameStatus::ok);
    CHECK(relative_l2_error(f, exact) < 1e-9);
  }
}

TEST_CASE("conjugate gradients with the matrix: units do not matter, and bad input is refused",
          "[skin][gradients]") {
  const LinearProblem problem = rectangle(3, 3).problem;
  std::vector<double> readings = frame_of(problem, 3);
  const std::vector<double> exact = tikhonov_solve(problem, gradients_alpha, readings);
  const SkinMatrixGradients inverse(problem, gradients_alpha);
  std::vector<double> f(exact.size(), 7.0);
  CHECK_THROWS_AS(SkinMatrixGradients(problem, -1.0), std::invalid_argument);
  CHECK_THROWS_AS(inverse.solve(std::vector<double>(2), f, 1), std::invalid_argument);
  CHECK_THROWS_AS(inverse.solve(readings, std::span(f).first(2), 1), std::invalid_argument);
  std::vector<double> large = readings;
  for (double& reading : large) reading *= 1e150;
  std::vector<double> of_large(f.size());
  REQUIRE(inverse.solve(large, of_large, 400) == FrameStatus::ok);
  for (double& value : of_large) value *= 1e-150;
  CHECK(relative_l2_error(of_large, exact) < 1e-9);
  readings[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(inverse.solve(readings, f, 1) == FrameStatus::too_large);
  CHECK(f == std::vector<double>(f.size(), 7.0));
  REQUIRE(inverse.solve(std::vector<double>(readings.size()), f, 5) == FrameStatus::ok);
  CHECK(f == std::vector<double>(f.size(), 0.0));
}
