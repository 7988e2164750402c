// P f = b itself by conjugate gradients, products by FFT.
#include "tactile_net/inverse/fft_tikhonov.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;
using enum Quantity;

TEST_CASE("conjugate gradients solve P f = b, boundaries included", "[fft_tikhonov]") {
  const double alpha = GENERATE(1e-6, 1e-3, 1.0);
  const std::size_t n = GENERATE(as<std::size_t>{}, 2, 3, 20, 81);
  const bool both = GENERATE(false, true);
  const bool layered = n == 20;
  const SensorArray array{
      n, 0.25, {1.0}, both ? std::vector{stress_x, shear_xy} : std::vector{strain_x}};
  Material material{1.0, 0.45};
  if (layered) material.layer = Layer{1.0, Base::bonded};
  LineProblemOptions options{.unknowns = both ? std::size_t{2} : std::size_t{1},
                             .smoothing_length = 1.0};
  if (n > 3) options.dead_taxels = {1};
  if (both) options.channel_rms = {1.0, 0.3};
  if (both) options.tangential_weight = n == 20 ? 0.3 : 2.5;
  const std::vector<double> g = random_values((both ? 2 : 1) * n, 8);
  FftTikhonov inverse(array, material, options, alpha);
  std::vector<double> f(inverse.tractions());
  REQUIRE(inverse.solve(g, f, 1e-9) == FrameStatus::ok);
  CAPTURE(alpha, n, both, layered, inverse.convergence().steps);
  CHECK(inverse.convergence().converged);
  const double error =
      relative_l2_error(f, tikhonov_solve(make_problem(array, material, options), alpha, g));
  CHECK(error <= 1e-8);
  CHECK(error <= inverse.convergence().bound + 1e-10);
}

TEST_CASE("conjugate gradients know a surface between and beyond the taxels", "[fft_tikhonov]") {
  const double pitch = GENERATE(0.5, 3.0);
  const double alpha = GENERATE(1e-4, 1e-2);
  const SensorArray array{20, pitch, {1.5}, {stress_x, shear_xy}};
  const LineProblemOptions options{.unknowns = 2,
                                   .smoothing_length = 1.0,
                                   .dead_taxels = {4},
                                   .surface = {.basis = SurfaceBasis::hats}};
  const LinearProblem problem = make_problem(array, pad, options);
  const std::vector<double> g = random_values(problem.kernel.rows, 3);
  FftTikhonov inverse(array, pad, options, alpha);
  REQUIRE(inverse.tractions() == problem.kernel.columns);
  std::vector<double> f(inverse.tractions());
  REQUIRE(inverse.solve(g, f, 1e-10, 10'000) == FrameStatus::ok);
  CAPTURE(pitch, alpha, inverse.convergence().steps);
  CHECK(inverse.convergence().converged);
  CHECK(relative_l2_error(f, tikhonov_solve(problem, alpha, g)) <= 1e-8);
}

TEST_CASE("frames that cannot be solved say so", "[fft_tikhonov]") {
  const SensorArray array{21, 0.5, {1.0}, {stress_x}};
  FftTikhonov solver(array, pad, {.smoothing_length = 1.0}, 1e-14);
  std::vector<double> f(21);
  REQUIRE(solver.solve(random_values(21, 1), f, 1e-14, 3) == FrameStatus::ok);
  CHECK_FALSE(solver.convergence().converged);
  CHECK(solver.solve(random_values(20, 1), f) == FrameStatus::wrong_size);
  std::vector<double> broken(21);
  broken[3] = std::nan("");
  CHECK(solver.solve(broken, f) == FrameStatus::not_finite);
  REQUIRE(solver.solve(std::vector<double>(21), f) == FrameStatus::ok);
  for (const double value : f) CHECK(value == 0.0);
  CHECK_THROWS_AS(FftTikhonov(array, pad, {}, 0.0), std::invalid_argument);
}
