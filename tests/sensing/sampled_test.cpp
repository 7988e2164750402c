#include "tactile_net/sensing/sampled.hpp"

#include <cmath>
#include <stdexcept>

#include "tactile_net/elasticity/half_plane.hpp"
#include "tests/catch.hpp"
#include "tests/sensing/pad.hpp"

using namespace tactile_net;

namespace {

const SensorArray nine_taxels{
    .count = 9,
    .pitch = 0.4,
    .depths = {0.7, 1.5},
    .reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::strain_y}};

std::vector<double> wave(std::size_t count, double frequency) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = 1.0 + std::sin(frequency * static_cast<double>(i));
  return values;
}

}  // namespace

TEST_CASE("the kernel's entries are k(m D) D", "[sampled]") {
  const Channel channel{Quantity::strain_x, 1.5, "strain_x"};
  const auto kernel = sampled_kernel(channel, Traction::tangential_y, pad, 4, 0.25);
  REQUIRE(kernel.size() == 7);
  for (int m = -3; m <= 3; ++m)
    CHECK(kernel[static_cast<std::size_t>(m + 3)] ==
          0.25 * half_plane_kernel(Quantity::strain_x, Traction::tangential_y, pad, 1.5, 0.25 * m));
}

TEST_CASE("a convolution with three values, by hand", "[sampled]") {
  // out(n) += sum_i kernel(n - i) in(i), kernel(-2 ... 2) = 1, 2, 3, 4, 5.
  const std::vector<double> kernel{1.0, 2.0, 3.0, 4.0, 5.0};
  const std::vector<double> in{1.0, 10.0, 100.0};
  std::vector<double> out{1000.0, 2000.0, 3000.0};
  add_convolution(kernel, in, out);
  CHECK(out == std::vector{1000.0 + 123.0, 2000.0 + 234.0, 3000.0 + 345.0});
}

TEST_CASE("a unit load at one taxel is read as that column of the kernel", "[sampled]") {
  TractionField field{.normal = std::vector<double>(9), .tangential = std::vector<double>(9)};
  field.normal[2] = 1.0;
  field.tangential[6] = -2.0;
  const auto readings = sampled_readings(nine_taxels, pad, field);
  REQUIRE(readings.size() == 6 * 9);
  auto reading = readings.begin();
  for (const Channel& channel : channels(nine_taxels))
    for (std::size_t n = 0; n < 9; ++n) {
      const double y = position(nine_taxels, n);
      const double expected =
          0.4 * (half_plane_kernel(channel.quantity, Traction::normal, pad, channel.depth,
                                   y - position(nine_taxels, 2)) -
                 2.0 * half_plane_kernel(channel.quantity, Traction::tangential_y, pad,
                                         channel.depth, y - position(nine_taxels, 6)));
      CAPTURE(channel.name, n);
      CHECK_THAT(*reading++, WithinAbs(expected, 1e-15));
    }
}

TEST_CASE("readings are linear in the field", "[sampled][property]") {
  const TractionField one{.normal = wave(9, 1.0), .tangential = wave(9, 2.0)};
  const TractionField two{.normal = wave(9, 0.3), .tangential = {}};
  TractionField sum = one;
  for (std::size_t i = 0; i < 9; ++i) {
    sum.normal[i] = 3.0 * one.normal[i] - two.normal[i];
    sum.tangential[i] = 3.0 * one.tangential[i];
  }
  const auto a = sampled_readings(nine_taxels, pad, one);
  const auto b = sampled_readings(nine_taxels, pad, two);
  const auto c = sampled_readings(nine_taxels, pad, sum);
  for (std::size_t i = 0; i < c.size(); ++i) CHECK_THAT(c[i], WithinAbs(3.0 * a[i] - b[i], 1e-14));
}

TEST_CASE("an empty tangential field is a field of zeros", "[sampled]") {
  const TractionField none{.normal = wave(9, 1.0), .tangential = {}};
  const TractionField zeros{.normal = none.normal, .tangential = std::vector<double>(9)};
  CHECK(sampled_readings(nine_taxels, pad, none) == sampled_readings(nine_taxels, pad, zeros));
}

TEST_CASE("units scale the sampled readings and nothing else", "[sampled][property]") {
  const double metre = GENERATE(1e-3, 1e3, 1e100);
  const double pascal = GENERATE(1.0, 1e6);
  SensorArray scaled = nine_taxels;
  scaled.pitch *= metre;
  for (double& depth : scaled.depths) depth *= metre;
  const Material stiff{.youngs_modulus = pad.youngs_modulus * pascal,
                       .poisson_ratio = pad.poisson_ratio};
  const TractionField field{.normal = wave(9, 1.0), .tangential = wave(9, 2.0)};
  const auto before = sampled_readings(nine_taxels, pad, field);
  const auto after = sampled_readings(scaled, stiff, field);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool strain = i >= 4 * 9;
    CHECK_THAT(after[i] * (strain ? pascal : 1.0), WithinAbs(before[i], 1e-14));
  }
}

TEST_CASE("readings are not made of parts that do not fit", "[sampled]") {
  const TractionField fits{.normal = wave(9, 1.0), .tangential = {}};
  SensorArray empty = nine_taxels;
  empty.reads.clear();
  CHECK_THROWS_AS(sampled_readings(empty, pad, fits), std::invalid_argument);
  CHECK_THROWS_AS(sampled_readings(nine_taxels, {.poisson_ratio = 0.6}, fits),
                  std::invalid_argument);
  const TractionField short_normal{.normal = wave(8, 1.0), .tangential = {}};
  CHECK_THROWS_WITH(sampled_readings(nine_taxels, pad, short_normal),
                    "normal must hold one value per taxel, 9 (got 8)");
  const TractionField long_tangential{.normal = wave(9, 1.0), .tangential = wave(10, 1.0)};
  CHECK_THROWS_WITH(sampled_readings(nine_taxels, pad, long_tangential),
                    "tangential must hold one value per taxel, 9 (got 10)");
}
