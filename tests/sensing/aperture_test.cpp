#include "tactile_net/sensing/aperture.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tactile_net/elasticity/hat_kernel.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/sensing/pad.hpp"

using namespace tactile_net;
using std::numbers::pi;

TEST_CASE("a point reads itself, to the bit", "[aperture]") {
  const Aperture point = GENERATE(Aperture{}, Aperture{0.0, 1.0});
  CHECK(point.mean([](double y) { return std::sin(y); }, 0.3) == std::sin(0.3));
}

TEST_CASE("a wide taxel reads a wave smaller by the factor of its transform",
          "[aperture][property]") {
  const double width = GENERATE(1e-6, 0.3, 1.0, 7.0, 900.0);
  for (const double k : {0.2, 1.0, 3.0}) {
    CAPTURE(width, k);
    const double factor = std::sin(0.5 * k * width) / (0.5 * k * width);
    CHECK_THAT(Aperture(width, 1.0).mean([&](double y) { return std::cos(k * y); }, 0.7),
               WithinAbs(factor * std::cos(0.7 * k), 1e-14));
  }
}

TEST_CASE("the transform of a wide taxel is what it makes of a wave", "[aperture][property]") {
  const Aperture wide(1.7, 0.6);
  for (const double k : {0.0, 0.4, 3.0, -3.0})
    CHECK_THAT(wide.mean([&](double y) { return std::cos(k * y); }, 0.0),
               WithinAbs(wide.transform(k), 1e-14));
  CHECK(Aperture{}.transform(3.0) == 1.0);
}

TEST_CASE("a wide taxel's reading is as even or odd as a point's, to the bit",
          "[aperture][property]") {
  const Aperture wide(GENERATE(0.3, 1.7, 9.0), 0.6);
  const PadKernel even(Quantity::stress_x, Traction::normal, pad, 0.6);
  const PadKernel odd(Quantity::stress_x, Traction::tangential_y, pad, 0.6);
  for (const double y : {0.1, 0.77, 5.0}) {
    CHECK(wide.mean(even, y) == wide.mean(even, -y));
    CHECK(wide.mean(odd, y) == -wide.mean(odd, -y));
  }
}

TEST_CASE("a wide taxel bears the force that passes through it", "[aperture][property]") {
  // The integral of 2 x^3 / (pi r^4) over y.
  const double depth = GENERATE(1e-3, 1.0);
  const double width = depth * GENERATE(0.01, 0.6, 2.5, 1e3, 1e4);
  const double y = depth * GENERATE(0.0, 0.4, -3.0);
  const auto force_up_to = [&](double end) {
    return (std::atan(end / depth) + end * depth / (end * end + depth * depth)) / pi;
  };
  const PadKernel line(Quantity::stress_x, Traction::normal, pad, depth);
  const double force = force_up_to(y + 0.5 * width) - force_up_to(y - 0.5 * width);
  CHECK_THAT(Aperture(width, depth).mean(line, y) * width, WithinAbs(force, 1e-13));
}

TEST_CASE("two taxels side by side read as much as one across both", "[aperture][property]") {
  const Material layer{
      .youngs_modulus = 2.0, .poisson_ratio = 0.3, .layer = Layer{1.1, Base::bonded}};
  const Material& material = GENERATE_REF(pad, layer);
  const double width = GENERATE(0.2, 1.9, 11.0);
  const Aperture whole(width, 0.7);
  const Aperture half(0.5 * width, 0.7);
  for (const Quantity quantity : line_quantities) {
    CAPTURE(name(quantity), width);
    const HatKernel hat(quantity, Traction::normal, material, 0.7, 0.3);
    const double left = half.mean(hat, 0.2 - 0.25 * width);
    const double right = half.mean(hat, 0.2 + 0.25 * width);
    CHECK_THAT(whole.mean(hat, 0.2), WithinAbs(0.5 * (left + right), 1e-14));
  }
}

TEST_CASE("exact readings of wide taxels are the mean over their width", "[aperture][exact]") {
  const std::array contacts{
      Contact{
          RigidContact{.shape = Shape::punch, .center = 0.3, .half_width = 0.8, .friction = 0.4}},
      Contact{SampledTractions{.first = -2.0, .pitch = 0.5, .normal = {1.0, 3.0}}}};
  const Channel channel{Quantity::strain_x, 0.4};
  const double width = 0.9;
  constexpr int parts = 2000;  // of the midpoint rule, whose error is its square
  std::vector<double> places;
  for (int i = 0; i < parts; ++i) places.push_back(((i + 0.5) / parts - 0.5) * width + 0.1);
  double mean = 0.0;
  for (const double reading : exact_readings(channel, places, pad, contacts))
    mean += reading / parts;
  const std::array middle{0.1};
  const auto wide = exact_readings(channel, middle, pad, contacts, {}, Aperture(width, 0.4));
  CHECK_THAT(wide[0], WithinRel(mean, 1e-6));
  const auto point = exact_readings(channel, middle, pad, contacts);
  CHECK(std::abs(point[0] - mean) > 1e-3 * std::abs(mean));
}

TEST_CASE("no taxel has less than no width", "[aperture]") {
  CHECK_THROWS_WITH(Aperture(-1.0, 1.0), "width must be >= 0 (got -1)");
  CHECK_THROWS_WITH(Aperture(1.0, 0.0), "depth must be > 0 (got 0)");
  CHECK_THROWS_WITH(Aperture(2e4, 1.0), "width must be at most 10000 depths, 10000 (got 20000)");
  CHECK_THROWS_WITH(Aperture(std::numeric_limits<double>::quiet_NaN(), 1.0),
                    StartsWith("width must be finite"));
}
