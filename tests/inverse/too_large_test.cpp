// Readings so large that tractions overflow a double: every solver says so, and leaves its output
// alone.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/thesis/closed_form.hpp"
#include "tactile_net/inverse/thesis/dft.hpp"
#include "tactile_net/inverse/thesis/dft_friction.hpp"
#include "tactile_net/inverse/thesis/dft_tikhonov.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t array_length = 41;
constexpr double tiny_alpha = 1e-12;
const SensorArray one_channel{array_length, 0.25, {1.5}, {Quantity::stress_x}};
const SensorArray two_channels{array_length, 0.25, {1.5}, {Quantity::stress_x, Quantity::shear_xy}};
const Material rubber{.youngs_modulus = 2e6, .poisson_ratio = 0.5};
const LineProblemOptions two_tractions{.unknowns = 2, .smoothing_length = 1.5};

using Solve = std::function<FrameStatus(std::span<const double>, std::span<double>)>;

struct Solver {
  const char* name;
  std::size_t readings, tractions;
  Solve solve;
};

template <class Inverse>
Solve shared(Inverse inverse, auto call) {
  return [inverse = std::make_shared<Inverse>(std::move(inverse)), call](auto g, auto f) {
    return call(*inverse, g, f);
  };
}

FrameStatus copy(const auto& solution, std::span<double> f) {
  if (solution.status != FrameStatus::ok) return solution.status;
  std::vector<double> all;
  if constexpr (requires { solution.tractions; }) {
    all = solution.tractions;
  } else {
    all = solution.normal;
    all.insert(all.end(), solution.tangential.begin(), solution.tangential.end());
  }
  std::copy(all.begin(), all.end(), f.begin());
  return FrameStatus::ok;
}

std::vector<Solver> solvers() {
  const LinearProblem problem = make_problem(two_channels, rubber, two_tractions);
  const auto plain = [](auto& inverse, auto g, auto f) { return inverse.solve(g, f); };
  return {
      {"tikhonov", 2 * array_length, 2 * array_length,
       shared(tikhonov(problem, tiny_alpha), plain)},
      {"closed_form", 2 * array_length, 2 * array_length,
       shared(closed_form(problem, tiny_alpha), plain)},
      {"dft", array_length, array_length, shared(DftInverse(one_channel, rubber), plain)},
      {"dft of two", 2 * array_length, 2 * array_length,
       shared(DftTikhonov(two_channels, rubber, two_tractions),
              [](auto& inverse, auto g, auto f) { return inverse.solve(g, tiny_alpha, f); })},
      {"fft", 2 * array_length, 2 * array_length,
       shared(FftTikhonov(two_channels, rubber, two_tractions, tiny_alpha),
              [](auto& inverse, auto g, auto f) { return inverse.solve(g, f); })},
      {"dft with friction", array_length, 2 * array_length,
       shared(DftFriction(one_channel, rubber, 0.4),
              [](auto& inverse, auto g, auto f) { return copy(inverse.solve(g), f); })},
      {"active set", 2 * array_length, 2 * array_length,
       shared(ConstrainedTikhonov(problem, tiny_alpha, {.nonnegative = false}),
              [](auto& inverse, auto g, auto f) { return copy(inverse.solve(g), f); })},
  };
}

/// Alternating readings at the last taxels of the first channel: amplified, and far from the first
/// traction.
std::vector<double> at_the_end(const Solver& solver, double size) {
  std::vector<double> readings(solver.readings);
  readings[array_length - 2] = size;
  readings[array_length - 1] = -size;
  return readings;
}

TEST_CASE("whatever is solved is finite, however large the readings", "[too_large]") {
  for (const Solver& solver : solvers())
    for (int exponent = 280; exponent <= 308; ++exponent) {
      CAPTURE(solver.name, exponent);
      std::vector<double> f(solver.tractions, 7.0);
      const FrameStatus status = solver.solve(at_the_end(solver, std::pow(10.0, exponent)), f);
      const bool finite =
          std::all_of(f.begin(), f.end(), [](double value) { return std::isfinite(value); });
      CHECK(finite);
      CHECK((status == FrameStatus::ok || status == FrameStatus::too_large));
      const bool alone = std::all_of(f.begin(), f.end(), [](double value) { return value == 7.0; });
      CHECK(alone == (status != FrameStatus::ok));
    }
}

TEST_CASE("linear solvers do not give up before they must", "[too_large]") {
  for (const Solver& solver : solvers()) {
    if (solver.name == std::string("dft with friction")) continue;  // squares readings
    CAPTURE(solver.name);
    std::vector<double> small(solver.tractions);
    std::vector<double> large(solver.tractions);
    const double scale = std::ldexp(1.0, 1000);
    REQUIRE(solver.solve(at_the_end(solver, 1.0), small) == FrameStatus::ok);
    REQUIRE(solver.solve(at_the_end(solver, scale), large) == FrameStatus::ok);
    for (std::size_t i = 0; i < small.size(); ++i) CHECK(large[i] == scale * small[i]);
  }
}

TEST_CASE("a product with a matrix is too large exactly where a sum overflows", "[too_large]") {
  constexpr double largest = std::numeric_limits<double>::max();
  const Reconstruction sum(Matrix{2, 2, {1.0, 1.0, 1.0, -1.0}}, 1.0);
  std::vector<double> f{7.0, 7.0};
  CHECK(sum.solve(std::vector{0.5 * largest, 0.5 * largest}, f) == FrameStatus::ok);
  CHECK(f == std::vector{largest, 0.0});
  f = {7.0, 7.0};
  CHECK(sum.solve(std::vector{0.75 * largest, 0.5 * largest}, f) == FrameStatus::too_large);
  CHECK(f == std::vector{7.0, 7.0});
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(sum.solve(std::vector{infinite, 0.0}, f) == FrameStatus::not_finite);
  CHECK(sum.solve(std::vector{0.0, std::nan("")}, f) == FrameStatus::not_finite);
  CHECK(f == std::vector{7.0, 7.0});
}

}  // namespace
}  // namespace tactile_net
