#include "tactile_net/inverse/identifiability.hpp"

#include <cmath>
#include <numbers>

#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;
using enum Quantity;

namespace {

InverseProblem pair_of(std::size_t count, double nu, std::vector<Quantity> reads,
                       std::vector<double> depths = {1.5}) {
  return make_problem({count, 0.5, std::move(depths), std::move(reads)}, {1.0, nu},
                      {.unknowns = 2});
}

}  // namespace

TEST_CASE("two strains on 81 taxels are singular, and the mode is named", "[identifiability]") {
  const Identifiability strains = identifiability(pair_of(81, 0.45, {strain_x, strain_y}));
  CHECK(strains.condition > 1e15);
  CHECK(strains.rank == 161);
  REQUIRE(strains.null_modes.size() == 1);
  CHECK(strains.null_modes[0].unknown == Traction::tangential);
  CHECK(strains.null_modes[0].share > 0.95);

  const Identifiability shear = identifiability(pair_of(81, 0.45, {stress_x, shear_xy}));
  CHECK(shear.condition < 1e6);
  CHECK(shear.rank == 162);
  CHECK(shear.null_modes.empty());
}

TEST_CASE("at nu = 0.5 two strains at one depth are one", "[identifiability]") {
  const Identifiability strains = identifiability(pair_of(21, 0.5, {strain_x, strain_y}));
  CHECK(strains.rank <= 21);
  CHECK(identifiability(pair_of(21, 0.5, {strain_x}, {1.0, 1.5})).rank >= 41);
}

TEST_CASE("a null mode moves no reading", "[identifiability][property]") {
  // The readings of the modes' span: none, to rounding. Here by the count alone: rank + modes.
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    const Identifiability result = identifiability(problem);
    CHECK(result.rank + result.null_modes.size() == problem.kernel.columns);
    for (std::size_t i = 0; i + 1 < result.singular_values.size(); ++i)
      CHECK(result.singular_values[i] >= result.singular_values[i + 1]);
    CHECK_THAT(result.noise_gain * result.singular_values.back(), WithinRel(1.0, 1e-12));
  }
}

TEST_CASE("the mean of the tangential load is hidden from two stresses alone",
          "[identifiability]") {
  const auto mean = [](std::vector<Quantity> reads) {
    return resolutions({40, 0.25, {1.5}, std::move(reads)}, {1.0, 0.45}, {.unknowns = 2});
  };
  CHECK(std::isinf(mean({stress_x, stress_y})[0].tangential));
  CHECK(std::isinf(mean({stress_x, stress_y})[20].tangential));  // Nyquist
  CHECK(std::isfinite(mean({stress_x, stress_y})[1].tangential));
  for (const Resolution& resolution : mean({stress_x, shear_xy})) {
    CHECK(std::isfinite(resolution.normal));
    CHECK(std::isfinite(resolution.tangential));
  }
}

TEST_CASE("shear and stress invert as their determinant says", "[identifiability]") {
  // f_v = e^a [(1-a) stress + i a shear], f_t = e^a [(1+a) shear + i a stress].
  const std::size_t n = 41;
  const auto all = resolutions({n, 0.25, {1.5}, {stress_x, shear_xy}}, {1.0, 0.3}, {.unknowns = 2});
  for (std::size_t j = 1; j < all.size(); ++j) {
    const double a = 2.0 * std::numbers::pi / all[j].wavelength * 1.5;
    const double factor = std::exp(a) * std::sqrt(2.0 / static_cast<double>(n));
    CHECK_THAT(all[j].normal, WithinRel(factor * std::hypot(1.0 - a, a), 1e-6));
    CHECK_THAT(all[j].tangential, WithinRel(factor * std::hypot(1.0 + a, a), 1e-6));
  }
}

TEST_CASE("the resolvable wavelength grows with the depth and with the noise",
          "[identifiability]") {
  const auto shortest = [](double depth, double limit) {
    return resolvable_wavelength(
        resolutions({81, 0.25, {depth}, {stress_x, shear_xy}}, {1.0, 0.45}, {.unknowns = 2}),
        Traction::normal, limit);
  };
  CHECK(*shortest(1.0, 10.0) < *shortest(2.0, 10.0));
  CHECK(*shortest(1.0, 100.0) < *shortest(1.0, 10.0));
  CHECK_FALSE(shortest(1.0, 1e-3).has_value());
}

TEST_CASE("units change nothing", "[identifiability][property]") {
  const auto shares = [](double length, double modulus) {
    const SensorArray array{31, 0.25 * length, {1.5 * length}, {strain_x, strain_y}};
    const Identifiability result =
        identifiability(make_problem(array, {modulus, 0.3}, {.unknowns = 2}));
    return std::pair(result.singular_values[20] / result.singular_values[0], result.rank);
  };
  const auto [share, rank] = shares(1.0, 1.0);
  for (const auto& [length, modulus] : {std::pair(1e-3, 1e6), std::pair(1e3, 1e-12)}) {
    CHECK_THAT(shares(length, modulus).first, WithinRel(share, 1e-10));
    CHECK(shares(length, modulus).second == rank);
  }
}
