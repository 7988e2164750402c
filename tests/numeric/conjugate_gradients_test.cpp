// Conjugate gradients on systems small enough to be multiplied out.
#include "numeric/conjugate_gradients.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/catch.hpp"

namespace {

using namespace tactile_net;

constexpr std::size_t size = 8;
using Values = std::array<double, size>;

/// Hilbert's matrix and a tenth of 1: symmetric and positive definite.
Values times_p(std::span<const double> x) {
  Values sums{};
  for (std::size_t i = 0; i < size; ++i) {
    sums[i] = 0.1 * x[i];
    for (std::size_t j = 0; j < size; ++j) sums[i] += x[j] / static_cast<double>(i + j + 1);
  }
  return sums;
}

struct Solved {
  Values x{};
  double power = 0.0;
  std::vector<double> gains{};
  std::vector<Values> steps{};  // x after each
};

/// @param trust  of the preconditioner: a diagonal of 1, 1 + trust, 1 + 2 trust, ...
Solved solved(const Values& right, double trust, std::size_t limit) {
  Solved result;
  Values gradient = right;
  Values z{};
  Values direction{};
  Values image{};
  result.power = conjugate_gradients(
      {result.x, gradient, z, direction}, limit,
      [&] {
        image = times_p(direction);
        return dot_in_order(direction, image);
      },
      [&](double step) { add_multiple(gradient, -step, image); },
      [&](std::span<const double> from, std::span<double> to) {
        for (std::size_t i = 0; i < size; ++i)
          to[i] = (1.0 + trust * static_cast<double>(i)) * from[i];
      },
      dot_in_order,
      [&](std::size_t steps, double gain) {
        CHECK(steps == result.steps.size() + 1);
        result.gains.push_back(gain);
        result.steps.push_back(result.x);
        return false;
      });
  return result;
}

/// The square of the distance in the norm of P.
double energy(const Values& x, const Values& y) {
  Values difference{};
  for (std::size_t i = 0; i < size; ++i) difference[i] = x[i] - y[i];
  return dot_in_order(difference, times_p(difference));
}

}  // namespace

TEST_CASE(
    "conjugate gradients end at the solution after as many steps as unknowns, whatever "
    "preconditions them",
    "[conjugate_gradients]") {
  const Values x{1.0, -2.0, 0.5, 3.0, 0.0, -1.0, 2.0, 0.25};
  const double trust = GENERATE(0.0, 0.5, 4.0);
  CAPTURE(trust);
  CHECK(energy(solved(times_p(x), trust, size).x, x) < 1e-16 * energy(x, {}));
}

TEST_CASE("a step's gain is what it takes off the square of the error in the norm of P",
          "[conjugate_gradients]") {
  const Values x{1.0, -2.0, 0.5, 3.0, 0.0, -1.0, 2.0, 0.25};
  const Solved run = solved(times_p(x), 0.5, 4);
  REQUIRE(run.steps.size() == 4);
  double before = energy({}, x);
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const double now = energy(run.steps[i], x);
    CHECK_THAT(before - now, WithinRel(run.gains[i], 1e-9));
    before = now;
  }
}

TEST_CASE("conjugate gradients make no step of nothing, and none that is not finite",
          "[conjugate_gradients]") {
  const Solved nothing = solved({}, 0.5, size);
  CHECK(nothing.power == 0.0);
  CHECK(nothing.steps.empty());
  Values huge{};
  huge.fill(1e200);  // whose square is too large
  const Solved overflow = solved(huge, 0.5, size);
  CHECK(std::isnan(overflow.power));
  CHECK(overflow.steps.empty());
  CHECK(overflow.x == Values{});
}
