#include "tactile_net/inverse/identifiability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;
using enum Quantity;

namespace {

SensorArray array_of(std::size_t count, std::vector<Quantity> reads,
                     std::vector<double> depths = {1.5}) {
  return {count, 0.5, std::move(depths), std::move(reads)};
}

Identifiability studied(const SensorArray& array, double nu, std::size_t unknowns = 2) {
  LineProblemOptions options{.unknowns = unknowns};
  for (const Channel& channel : channels(array))  // about equal parts of the noise
    options.channel_rms.push_back(is_strain(channel.quantity) ? 0.5 : 1.0);
  return identifiability(make_problem(array, {1.0, nu}, options));
}

/// Equal but for the singular value.
bool same_shape(const TractionMode& a, const TractionMode& b, double tolerance = 1e-6) {
  const auto near = [&](double x, double y) { return std::abs(x - y) <= tolerance * std::abs(y); };
  return a.unknown == b.unknown && a.parity == b.parity && a.alternating == b.alternating &&
         a.wavelength.has_value() == b.wavelength.has_value() &&
         near(a.wavelength.value_or(0.0), b.wavelength.value_or(0.0)) &&
         near(a.wave_share, b.wave_share);
}

}  // namespace

TEST_CASE("two strains on 81 taxels are singular, and the mode is described", "[identifiability]") {
  // The design's numbers: "about 5e17" is rounding over the largest value, 1e5 is 1.3e5.
  const double pitch = GENERATE(0.25, 0.5);
  CAPTURE(pitch);
  const auto pair_of = [&](std::vector<Quantity> reads) {
    return identifiability(
        make_problem({81, pitch, {1.5}, std::move(reads)}, {1.0, 0.45}, {.unknowns = 2}));
  };
  const Identifiability strains = pair_of({strain_x, strain_y});
  CHECK(strains.condition > 1e15);
  CHECK(strains.rank == 161);
  REQUIRE(strains.null_space.modes.size() == 1);
  const TractionMode& mode = strains.null_space.modes[0];
  CHECK(mode.unknown == Traction::tangential_y);
  CHECK(mode.parity == Parity::even);
  CHECK(mode.alternating);
  REQUIRE(mode.wavelength.has_value());
  CHECK(same_shape(strains.weakest, mode));

  const Identifiability shear = pair_of({stress_x, shear_xy});
  CHECK(shear.rank == 162);
  CHECK(shear.null_space.dimension == 0);
  CHECK(shear.condition < (pitch == 0.5 ? 2e5 : 2e9));
}

TEST_CASE("what counting says is lost is lost, and nothing else", "[identifiability][property]") {
  const std::size_t count = GENERATE(as<std::size_t>{}, 8, 9, 20, 21);
  const bool odd = count % 2 == 1;
  CAPTURE(count);
  const auto check = [&](const SensorArray& array, std::size_t unknowns, std::size_t lost) {
    CAPTURE(name(array.reads[0]), array.reads.size(), array.depths.size(), unknowns);
    CHECK(lost_by_symmetry(array, unknowns) == lost);
    CHECK(studied(array, 0.3, unknowns).null_space.dimension == lost);
  };
  for (std::size_t i = 0; i < line_quantities.size(); ++i) {
    const bool is_shear = line_quantities[i] == shear_xy;
    check(array_of(count, {line_quantities[i]}), 1, odd && is_shear ? 1 : 0);
    check(array_of(count, {line_quantities[i]}, {0.75, 1.5}), 2, odd ? 1 : 0);
    for (std::size_t j = i + 1; j < line_quantities.size(); ++j) {
      const bool one_shear = is_shear || line_quantities[j] == shear_xy;
      check(array_of(count, {line_quantities[i], line_quantities[j]}), 2,
            odd && !one_shear ? 1 : 0);
    }
  }
  check(array_of(count, {stress_x, stress_y, shear_xy}), 2, 0);
}

TEST_CASE("two shears lose the normal traction, two stresses the tangential one",
          "[identifiability]") {
  const Identifiability shears = studied(array_of(21, {shear_xy}, {0.75, 1.5}), 0.3);
  REQUIRE(shears.null_space.dimension == 1);
  CHECK(shears.weakest.normal_share > 0.5);
  CHECK(shears.weakest.parity == Parity::even);
  const Identifiability stresses = studied(array_of(21, {stress_x}, {0.75, 1.5}), 0.3);
  REQUIRE(stresses.null_space.dimension == 1);
  CHECK(stresses.weakest.normal_share < 0.5);
  CHECK(stresses.weakest.parity == Parity::even);
}

TEST_CASE("at nu = 0.5 two strains at one depth are one", "[identifiability]") {
  const Identifiability strains = studied(array_of(21, {strain_x, strain_y}), 0.5);
  CHECK(strains.rank == 21);
  CHECK(strains.null_space.dimension == 21);
  CHECK(strains.null_space.shortest < 1.1);     // two pitches
  CHECK(strains.null_space.longest > 10.0);     // the array
  CHECK(strains.null_space.modes.size() == 6);  // not all of them are told
  for (const TractionMode& mode : strains.null_space.modes) CHECK(mode.wave_share > 0.9);
  CHECK(studied(array_of(21, {strain_x}, {1.0, 1.5}), 0.5).rank == 41);
}

TEST_CASE("modes do not depend on the basis that a decomposition happens to choose",
          "[identifiability][property]") {
  // The same rows in another order: a degenerate space comes in another basis.
  const double nu = GENERATE(0.3, 0.5);
  const auto modes = [&](std::vector<Quantity> reads) {
    return studied(array_of(21, std::move(reads)), nu).null_space.modes;
  };
  const std::vector<TractionMode> one = modes({strain_x, strain_y});
  const std::vector<TractionMode> other = modes({strain_y, strain_x});
  CHECK_FALSE(one.empty());
  REQUIRE(one.size() == other.size());
  for (std::size_t i = 0; i < one.size(); ++i) CHECK(same_shape(one[i], other[i]));
}

TEST_CASE("a null mode moves no reading", "[identifiability][property]") {
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    const Identifiability result = identifiability(problem);
    const std::vector<double>& s = result.singular_values;
    CHECK(result.rank + result.null_space.dimension == problem.kernel.columns);
    for (std::size_t i = 0; i + 1 < s.size(); ++i) CHECK(s[i] >= s[i + 1]);
    for (const TractionMode& mode : result.null_space.modes)
      CHECK(mode.singular_value <= 2.0 * result.floor);
    for (const TractionMode& mode : result.nearly_null.modes) {
      CHECK(mode.singular_value <= 2e-8 * s.front());
      CHECK(mode.singular_value >= 0.5 * s.back());
    }
    CHECK(result.weakest.singular_value <= std::max(1.001 * s.back(), result.floor));
    if (s.back() > 0.0) {
      CHECK_THAT(result.noise_gain * s.back(), WithinRel(1.0, 1e-12));
      CHECK_THAT(result.condition * s.back(), WithinRel(s.front(), 1e-12));
    }
  }
}

TEST_CASE("what is hidden can be asked for alone", "[identifiability][property]") {
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    const ModeSpace whole = identifiability(problem).null_space;
    const ModeSpace hidden = hidden_modes(problem);
    CHECK(hidden.dimension == whole.dimension);
    CHECK(hidden.longest == whole.longest);
    CHECK(hidden.shortest == whole.shortest);
    REQUIRE(hidden.modes.size() == std::min<std::size_t>(whole.dimension, 1));
    if (whole.dimension > 0) CHECK(same_shape(hidden.modes[0], whole.modes[0], 0.0));
    const ModeSpace known = hidden_modes(problem, TikhonovFamily(problem));
    CHECK(known.dimension == whole.dimension);
    CHECK(known.longest == whole.longest);
  }
  const LinearProblem strains =
      make_problem(array_of(21, {strain_x, strain_y}), {1.0, 0.5}, {.unknowns = 2});
  CHECK(hidden_modes(strains).dimension == 21);
  CHECK(hidden_modes(strains).modes.size() == 1);
}

TEST_CASE("a space of nothing but waves is described by them, the longest first",
          "[identifiability]") {
  // No reading at all but one: every traction orthogonal to a row is a null mode.
  LinearProblem problem = make_problem(array_of(16, {stress_x}), {1.0, 0.3});
  for (std::size_t i = 0; i < 16; ++i)
    for (std::size_t j = 0; j < 16; ++j)
      problem.kernel(i, j) = i == 0 ? (j % 2 == 0 ? 1.0 : -1.0) : 0.0;
  const Identifiability result = identifiability(problem);
  CHECK(result.rank == 1);
  CHECK(result.null_space.dimension == 15);
  REQUIRE(result.null_space.modes.size() == 6);
  const TractionMode& constant = result.null_space.modes[0];
  CHECK(constant.unknown == Traction::normal);
  CHECK(constant.parity == Parity::even);
  CHECK(constant.wave_share > 1.0 - 1e-12);
  CHECK_FALSE(constant.wavelength.has_value());
  for (std::size_t i = 2; i < 6; ++i)
    CHECK(*result.null_space.modes[i].wavelength <= *result.null_space.modes[i - 1].wavelength);
  CHECK(std::isinf(result.null_space.longest));
  CHECK(result.null_space.shortest > 1.0);  // the one that alternates is read
}

TEST_CASE("the reading of a dead taxel is missed", "[identifiability]") {
  const SensorArray array = array_of(12, {stress_x});
  const Material material{1.0, 0.3};
  CHECK(identifiability(make_problem(array, material)).null_space.dimension == 0);
  const Identifiability result =
      identifiability(make_problem(array, material, {.dead_taxels = {3, 7}}));
  CHECK(result.null_space.dimension == 2);
}

TEST_CASE("what smoothing leaves of short waves is nearly null", "[identifiability]") {
  const Identifiability deep =
      identifiability(make_problem({81, 0.25, {2.5}, {stress_x}}, {1.0, 0.3}));
  CHECK(deep.null_space.dimension == 0);
  CHECK(deep.nearly_null.dimension > 0);
  CHECK(deep.nearly_null.longest < 1.0);
  CHECK_THAT(deep.nearly_null.shortest, WithinRel(0.5, 1e-12));
}

TEST_CASE("units change nothing", "[identifiability][property]") {
  const auto result = [](double length, double modulus, double noise) {
    const SensorArray array{31, 0.25 * length, {1.5 * length}, {strain_x, strain_y}};
    return identifiability(
        make_problem(array, {modulus, 0.3},
                     {.unknowns = 2, .channel_rms = {noise / modulus, 2.0 * noise / modulus}}));
  };
  const Identifiability one = result(1.0, 1.0, 1.0);
  for (const auto& [length, modulus, noise] :
       {std::tuple(1e-3, 1e6, 1e-4), std::tuple(1e3, 1e-12, 1e9)}) {
    const Identifiability other = result(length, modulus, noise);
    CHECK_THAT(other.singular_values[50] / other.singular_values[0],
               WithinRel(one.singular_values[50] / one.singular_values[0], 1e-10));
    CHECK_THAT(other.singular_values[50] * noise, WithinRel(one.singular_values[50], 1e-10));
    CHECK(other.rank == one.rank);
    CHECK(other.nearly_null.dimension == one.nearly_null.dimension);
    CHECK(other.weakest.parity == one.weakest.parity);
    CHECK(other.weakest.unknown == one.weakest.unknown);
    CHECK(other.weakest.alternating == one.weakest.alternating);
    REQUIRE(other.weakest.wavelength.has_value());
    CHECK_THAT(*other.weakest.wavelength, WithinRel(length * *one.weakest.wavelength, 1e-12));
  }
}
