#include "lab/unseen_width.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tactile_net/lab/identify.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::lab;

namespace {

const Material half_plane{.youngs_modulus = 1.0, .poisson_ratio = 0.45};

/// The largest reading over its noise that a strip of largest traction 1 causes, by the forward
/// model.
double largest(const SensorArray& array, const Material& material, std::span<const double> rms,
               double width, double middle) {
  const std::vector<Contact> strip = {RigidContact{
      .center = middle, .half_width = 0.5 * width, .force = 0.25 * std::numbers::pi * width}};
  const std::vector<double> readings = exact_readings(array, material, strip);
  double most = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i)
    most = std::max(most, std::abs(readings[i]) / rms[i / array.count]);
  return most;
}

}  // namespace

TEST_CASE("a strip of the unseen width is read as loud as the noise where it is read least",
          "[unseen_width]") {
  struct Case {
    SensorArray array;
    std::vector<double> rms;
    Material material = half_plane;
  };
  const Material layer{
      .youngs_modulus = 1.0, .poisson_ratio = 0.45, .layer = Layer{.thickness = 3.0}};
  for (const auto& [array, rms, material] :
       {Case{{9, 2.0, {1.0}, {Quantity::stress_x}}, {0.05}},
        Case{{8, 4.0, {1.0}, {Quantity::stress_x}}, {0.02}},
        Case{{21, 0.5, {1.0}, {Quantity::shear_xy}}, {0.02}},
        Case{{9, 2.0, {1.0}, {Quantity::stress_x, Quantity::shear_xy}}, {0.05, 0.03}},
        Case{{9, 2.0, {1.0, 2.0}, {Quantity::stress_x}}, {0.05, 0.08}},
        Case{{9, 2.0, {1.0}, {Quantity::stress_x}}, {0.05}, layer}}) {
    CAPTURE(array.count, array.pitch, array.reads.size());
    const auto width = unseen_width(array, material, rms, {}, 1.0);
    REQUIRE(width.has_value());
    // From one taxel in the middle to the next.
    double least = 1e9;
    for (int place = 0; place <= 16; ++place) {
      const double middle = position(array, (array.count - 1) / 2) + array.pitch * place / 16.0;
      least = std::min(least, largest(array, material, rms, *width, middle));
    }
    CHECK_THAT(least, WithinRel(1.0, 0.02));  // between the places it may be a little less
  }
}

TEST_CASE("the unseen width is a length, and grows with noise over traction", "[unseen_width]") {
  const SensorArray array{9, 2.0, {1.0}, {Quantity::stress_x}};
  const auto width = [](const SensorArray& one, double rms, double traction) {
    return unseen_width(one, half_plane, std::vector{rms}, {}, traction);
  };
  const double reference = *width(array, 0.05, 1.0);
  CHECK_THAT(*width({9, 2e-3, {1e-3}, {Quantity::stress_x}}, 0.05, 1.0),
             WithinRel(1e-3 * reference, 1e-5));
  CHECK_THAT(*width(array, 0.1, 2.0), WithinRel(reference, 1e-5));
  CHECK(*width(array, 0.1, 1.0) > reference);
  CHECK(*width({9, 3.0, {1.0}, {Quantity::stress_x}}, 0.05, 1.0) > reference);
  CHECK_FALSE(width(array, 2.0, 1.0));  // a stress below the surface is never larger than on it
}

TEST_CASE("a dead taxel leaves a wider gap, and one live taxel none", "[unseen_width]") {
  const SensorArray array{9, 2.0, {1.0}, {Quantity::stress_x}};
  const std::vector<double> rms = {0.05};
  const double all = *unseen_width(array, half_plane, rms, {}, 1.0);
  CHECK(*unseen_width(array, half_plane, rms, std::vector<std::size_t>{2}, 1.0) > 1.5 * all);
  CHECK_FALSE(unseen_width({2, 2.0, {1.0}, {Quantity::stress_x}}, half_plane, rms,
                           std::vector<std::size_t>{0}, 1.0));
}

TEST_CASE("identify has the width that falls between two taxels", "[unseen_width]") {
  const Survey survey =
      identify(parse_scene("[sensor]\ncount = 9\npitch = 4.0\ndepth = 1.0\nreads = [\"stress_x\"]\n"
                           "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n",
                           "s.toml"));
  REQUIRE(survey.own.unseen.has_value());
}
