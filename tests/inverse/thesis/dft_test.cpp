#include "tactile_net/inverse/thesis/dft.hpp"

#include <array>
#include <limits>
#include <stdexcept>

#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/circular_readings.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

/// The thesis' array: x = 1.5 unless said, D = 0.5, 121 points.
SensorArray thesis_array(Quantity quantity, double depth = 1.5) {
  return {121, 0.5, {depth}, {quantity}};
}
const Material thesis_material{1.0, 0.5};

double example_error(Quantity quantity) {
  const SensorArray array = thesis_array(quantity);
  const Contact cylinder = RigidContact{.half_width = 1.0, .force = 3.534};
  const TractionField truth = sample(std::array{cylinder}, array);
  const std::vector<double> g = sampled_readings(array, thesis_material, truth);
  DftInverse inverse(array, thesis_material);
  std::vector<double> f(121);
  REQUIRE(inverse.solve(g, f) == FrameStatus::ok);
  CHECK(inverse.verdict(g) == DftVerdict::ok);
  return mean_absolute_error(f, truth.normal);
}

}  // namespace

TEST_CASE("Example 3.1's printed errors come out to three digits", "[dft][thesis]") {
  CHECK_THAT(example_error(Quantity::stress_x), WithinRel(3.03e-7, 0.5 / 303.0));
  CHECK_THAT(example_error(Quantity::strain_x), WithinRel(4.04e-5, 0.5 / 404.0));
}

TEST_CASE("a load on the circle comes back", "[dft][property]") {
  const std::size_t count = GENERATE(as<std::size_t>{}, 2, 3, 8, 41, 97, 100);
  CAPTURE(count);
  const SensorArray array{count, 0.5, {1.0}, {Quantity::stress_x}};
  const std::vector<double> f = random_values(count, 21);
  DftInverse inverse(array, thesis_material);
  std::vector<double> g = circular_readings(array, thesis_material, f);
  std::vector<double> found(count);
  REQUIRE(inverse.solve(g, found) == FrameStatus::ok);
  CHECK(relative_l2_error(found, f) <= 1e-13 * inverse.noise_gain().largest);
}

TEST_CASE("no error of the readings is amplified by more than the noise gain", "[dft][property]") {
  const SensorArray array = thesis_array(Quantity::strain_x);
  DftInverse inverse(array, thesis_material);
  const std::vector<double> f = random_values(121, 22);
  std::vector<double> g = circular_readings(array, thesis_material, f);
  const std::vector<double> clean = g;
  const std::vector<double> noise = random_values(121, 23);
  for (std::size_t i = 0; i < g.size(); ++i) g[i] += 1e-3 * noise[i];
  std::vector<double> found(121);
  REQUIRE(inverse.solve(g, found) == FrameStatus::ok);
  CHECK(relative_l2_error(found, f) <=
        (1.0 + 1e-9) * inverse.noise_gain().largest * relative_l2_error(g, clean));
}

TEST_CASE("the truncated kernel's DFT is not always positive, as the thesis has it",
          "[dft][thesis]") {
  // 10 and 30 of 121 entries are negative: 5 and 15 of the 61 that are not mirrored.
  const double any = std::numeric_limits<double>::max();
  const DftInverse strain(thesis_array(Quantity::strain_x, 3.0), thesis_material, any);
  CHECK(strain.noise_gain().sign_changes == 5);
  CHECK(strain.verdict() == DftVerdict::sign_change);
  const DftInverse stress(thesis_array(Quantity::stress_x, 5.0), thesis_material, any);
  CHECK(stress.noise_gain().sign_changes == 15);
  CHECK(stress.verdict() == DftVerdict::sign_change);
}

TEST_CASE("a division by almost nothing is refused unless asked for", "[dft]") {
  const SensorArray deep{81, 0.25, {2.5}, {Quantity::stress_x}};
  CHECK_THROWS_WITH(DftInverse(deep, thesis_material, 1e3),
                    ContainsSubstring("would multiply errors of the readings by up to") &&
                        ContainsSubstring("wavelength"));
  CHECK_NOTHROW(DftInverse(deep, thesis_material, 1e300));
}

TEST_CASE("the mean traction is invisible to the shear", "[dft]") {
  CHECK_THROWS_WITH(DftInverse(thesis_array(Quantity::shear_xy), thesis_material, 1e12),
                    ContainsSubstring("the mean of the traction is invisible to shear_xy"));
}

TEST_CASE("much noise gain is a verdict before it is an error", "[dft]") {
  const DftInverse inverse({41, 0.5, {2.3}, {Quantity::stress_x}}, thesis_material);
  CHECK(inverse.noise_gain().largest > 1e4);
  CHECK(inverse.verdict() != DftVerdict::ok);
}

TEST_CASE("readings cut off by the array's end are said to be", "[dft]") {
  const SensorArray array{81, 0.25, {0.75}, {Quantity::stress_x}};
  const Contact at_edge = RigidContact{.center = 9.0, .half_width = 1.0};
  const Contact central = RigidContact{.half_width = 1.0};
  const DftInverse inverse(array, thesis_material);
  const auto readings = [&](const Contact& contact) {
    return sampled_readings(array, thesis_material, sample(std::array{contact}, array));
  };
  CHECK(inverse.verdict(readings(at_edge)) == DftVerdict::cut_off);
  CHECK(inverse.verdict(readings(central)) == DftVerdict::ok);
}

TEST_CASE("an impossible set-up is refused", "[dft]") {
  const SensorArray two{21, 0.5, {1.0}, {Quantity::stress_x, Quantity::stress_y}};
  CHECK_THROWS_WITH(DftInverse(two, thesis_material),
                    ContainsSubstring("one quantity at one depth"));
  CHECK_THROWS_AS(DftInverse(thesis_array(Quantity::stress_x), thesis_material, 0.5),
                  std::invalid_argument);
  CHECK_THROWS_AS(DftInverse(thesis_array(Quantity::stress_x, -1.0), thesis_material),
                  std::invalid_argument);
  CHECK_THROWS_AS(DftInverse(thesis_array(Quantity::stress_x), {1.0, 0.7}), std::invalid_argument);
}

TEST_CASE("verdicts have the names that results use", "[dft]") {
  CHECK(name(DftVerdict::ok) == "ok");
  CHECK(name(DftVerdict::noise_amplified) == "noise_amplified");
  CHECK(name(DftVerdict::sign_change) == "sign_change");
  CHECK(name(DftVerdict::cut_off) == "cut_off");
}

TEST_CASE("uneven taxels have no spectrum", "[dft][uneven]") {
  const Material silicone{.youngs_modulus = 2e5, .poisson_ratio = 0.45};
  const std::vector<Quantity> reads = {Quantity::stress_x};
  const SensorArray array = uneven_array({{.y = -1e-3, .depth = 1.5e-3, .reads = reads},
                                          {.y = 0.0, .depth = 1.5e-3, .reads = reads},
                                          {.y = 2e-3, .depth = 1.5e-3, .reads = reads}});
  CHECK_THROWS_WITH(DftInverse(array, silicone),
                    ContainsSubstring("dft needs taxels equally far apart"));
}
