#include "tactile_net/sensing/spectral.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "sensing/spectral_convolution.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

std::vector<double> random_values(std::size_t size, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::vector<double> values(size);
  for (double& value : values) value = 2.0 * static_cast<double>(engine()) / 4294967295.0 - 1.0;
  return values;
}

double largest(const std::vector<double>& values) {
  return std::transform_reduce(
      values.begin(), values.end(), 0.0, [](double a, double b) { return std::max(a, b); },
      [](double x) { return std::abs(x); });
}

double sum_of_magnitudes(const std::vector<double>& values) {
  return std::transform_reduce(values.begin(), values.end(), 0.0, std::plus<>{},
                               [](double x) { return std::abs(x); });
}

void check_close(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  REQUIRE(a.size() == b.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  CHECK_THAT(worst, WithinAbs(0.0, tolerance));
}

}  // namespace

TEST_CASE("the transform's way and the sum's give the same", "[spectral][property]") {
  const auto count = static_cast<std::size_t>(
      GENERATE(2, 3, 4, 5, 7, 8, 13, 16, 31, 64, 97, 100, 101, 255, 511, 512, 997, 1000));
  CAPTURE(count);
  const auto kernel = random_values(2 * count - 1, 1);
  SpectralConvolution convolution(kernel);
  for (const std::uint32_t seed : {2U, 3U}) {  // twice: nothing is left over from the first
    const auto in = random_values(count, seed);
    auto expected = random_values(count, 4);
    auto out = expected;
    add_convolution(kernel, in, expected);
    convolution.add(in, out);
    check_close(out, expected, 1e-13 * largest(kernel) * sum_of_magnitudes(in));
  }
}

TEST_CASE("nothing wraps around from one end to the other", "[spectral]") {
  // A load at one end is read at the other through the kernel's last entry alone.
  const std::size_t count = 17;
  std::vector<double> kernel(2 * count - 1);
  kernel.back() = 1.0;
  std::vector<double> in(count);
  in.front() = 1.0;
  std::vector<double> out(count);
  SpectralConvolution(kernel).add(in, out);
  std::vector<double> expected(count);
  expected.back() = 1.0;
  check_close(out, expected, 1e-15);
}

TEST_CASE("a plan may move", "[spectral]") {
  const auto kernel = random_values(9, 1);
  const auto in = random_values(5, 2);
  std::vector<double> before(5);
  std::vector<double> after(5);
  SpectralConvolution first(kernel);
  first.add(in, before);
  SpectralConvolution second(std::move(first));
  SpectralConvolution third(random_values(3, 3));
  third = std::move(second);
  third.add(in, after);
  CHECK(before == after);
}

TEST_CASE("a kernel without a middle is refused", "[spectral]") {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{8}}) {
    CAPTURE(size);
    CHECK_THROWS_AS(SpectralConvolution(std::vector<double>(size)), std::invalid_argument);
  }
  CHECK_THROWS_WITH(SpectralConvolution(std::vector<double>(8)),
                    "kernel must hold 2 count - 1 >= 3 values (got 8)");
}

TEST_CASE("the faster way gives the readings of the other", "[spectral][property]") {
  const std::size_t count = GENERATE(std::size_t{2}, std::size_t{81}, spectral_crossover - 1,
                                     spectral_crossover, spectral_crossover + 1, std::size_t{1499});
  CAPTURE(count);
  const SensorArray array{.count = count,
                          .pitch = 0.01,
                          .depths = {0.05, 0.4},
                          .reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::strain_y}};
  const Material pad{.youngs_modulus = 1e5, .poisson_ratio = 0.4};
  const std::vector<Contact> contacts{RigidContact{.friction = 0.5}};
  const TractionField field = sample(contacts, array);
  const auto expected = sampled_readings(array, pad, field);
  const auto readings = fast_sampled_readings(array, pad, field);
  REQUIRE(readings.size() == expected.size());
  for (std::size_t channel = 0; channel < 6; ++channel) {
    const auto begin = static_cast<std::ptrdiff_t>(channel * count);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    const std::vector<double> one(readings.begin() + begin, readings.begin() + end);
    const std::vector<double> other(expected.begin() + begin, expected.begin() + end);
    check_close(one, other, 1e-13 * largest(other));
  }
}

TEST_CASE("the faster way refuses what the other refuses", "[spectral]") {
  const std::size_t count = GENERATE(std::size_t{9}, 2 * spectral_crossover);
  SensorArray array{.count = count, .pitch = 0.1, .depths = {1.0}, .reads = {Quantity::stress_x}};
  const TractionField fits{.normal = std::vector<double>(count), .tangential = {}};
  const TractionField shorter{.normal = std::vector<double>(count - 1), .tangential = {}};
  CHECK_NOTHROW(fast_sampled_readings(array, {}, fits));
  CHECK_THROWS_AS(fast_sampled_readings(array, {}, shorter), std::invalid_argument);
  CHECK_THROWS_AS(fast_sampled_readings(array, {.youngs_modulus = -1.0}, fits),
                  std::invalid_argument);
  array.pitch = 0.0;
  CHECK_THROWS_AS(fast_sampled_readings(array, {}, fits), std::invalid_argument);
}
