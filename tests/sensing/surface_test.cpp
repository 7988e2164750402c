#include "tactile_net/sensing/surface.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/sensing/resultant.hpp"
#include "tactile_net/sensing/surface_kernel.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

SensorArray array_of(std::size_t count, double pitch, double depth) {
  return {count, pitch, {depth}, {Quantity::stress_x, Quantity::shear_xy}};
}

Surface grid(const SensorArray& array, SurfaceOptions options = {}) {
  options.basis = SurfaceBasis::hats;
  return surface_of(array, options);
}

}  // namespace

TEST_CASE("tractions at the taxels are a surface too", "[surface]") {
  const SensorArray array = array_of(9, 0.5, 1.5);
  const Surface surface = surface_of(array);
  CHECK(positions(surface) == positions(array));
  CHECK(surface.spacing == array.pitch);
  CHECK(measure_of(array, surface) == 1.0);
}

TEST_CASE("every taxel lies on a value's place, and the margin reaches as far as asked",
          "[surface]") {
  for (const double pitch : {0.3, 0.75, 1.5, 3.0, 6.1})
    for (const double spacing : {0.0, 0.2, 0.37, 1.0, 9.0})
      for (const double margin : {-1.0, 0.0, 0.4, 3.0, 15.0}) {
        CAPTURE(pitch, spacing, margin);
        const SensorArray array = array_of(7, pitch, 1.5);
        SurfaceOptions options;
        if (spacing > 0.0) options.spacing = spacing;
        if (margin >= 0.0) options.margin = margin;
        const Surface surface = grid(array, options);
        for (std::size_t j = 0; j < array.count; ++j)
          CHECK_THAT(surface.position(surface.margin + j * surface.stride),
                     WithinAbs(position(array, j), 1e-13 * pitch * 7.0));
        if (spacing > 0.0) CHECK(surface.spacing <= spacing * (1.0 + 1e-12));
        CHECK(surface.count == 6 * surface.stride + 2 * surface.margin + 1);
        const double reach = surface.spacing * static_cast<double>(surface.margin + 1);
        const double wanted = margin < 0.0 ? 3.0 : margin;
        CHECK(reach >= wanted * (1.0 - 1e-12));
        CHECK(reach < std::max(wanted, surface.spacing * 1e-9) + surface.spacing);
        const SurfaceGrid column = grid_of(surface);
        REQUIRE(column.count() == surface.count);
        CHECK(column.area() == surface.spacing);
        for (std::size_t i = 0; i < surface.count; ++i) CHECK(column.y(i) == surface.position(i));
        const Surface back = surface_of(column);
        CHECK(back.basis == surface.basis);
        CHECK(positions(back) == positions(surface));
        CHECK(back.margin == surface.margin);
        CHECK(back.stride == surface.stride);
        CHECK_THAT(measure_of(array, surface), WithinRel(surface.spacing / pitch, 1e-14));
      }
}

TEST_CASE("what two parts of a surface amount to is what all of it does", "[surface]") {
  const Surface surface{.count = 9, .spacing = 0.5};
  const std::vector<double> normal{1.0, 3.0, 2.0, 0.0, 0.5, 4.0, 2.5, 1.5, 0.25};
  const std::vector<double> drag{0.5, -1.0, 0.25, 2.0, 0.0, -3.0, 1.0, 0.75, 4.0};
  for (const std::vector<double>& tangential : {drag, std::vector<double>{}})
    for (std::size_t cut = 0; cut <= surface.count; ++cut) {
      const Resultant whole = resultant_of(normal, tangential, surface);
      const Resultant one = resultant_between(0, cut, normal, tangential, surface);
      const Resultant other = resultant_between(cut, surface.count, normal, tangential, surface);
      CAPTURE(cut);
      CHECK_THAT(one.normal + other.normal, WithinRel(whole.normal, 1e-14));
      CHECK_THAT(one.tangential + other.tangential, WithinAbs(whole.tangential, 1e-14));
      CHECK_THAT(one.moment + other.moment, WithinAbs(whole.moment, 1e-14));
    }
}

TEST_CASE("the spacing follows the depth where taxels are far apart", "[surface]") {
  CHECK(grid(array_of(9, 0.75, 1.5)).spacing == 0.75);  // half of a depth: dense
  const Surface coarse = grid(array_of(9, 3.0, 1.5));
  CHECK(coarse.spacing == 0.375);
  CHECK(coarse.count == 8 * 8 + 2 * 7 + 1);
  SensorArray two_depths = array_of(9, 3.0, 1.5);
  two_depths.depths = {3.0, 1.0};
  CHECK(grid(two_depths).spacing == 0.25);
}

TEST_CASE("a surface that cannot be is refused", "[surface]") {
  const SensorArray array = array_of(9, 3.0, 1.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(grid(array, {.spacing = bad}), std::invalid_argument);
  for (const double bad : {-1e-9, nan, std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(grid(array, {.margin = bad}), std::invalid_argument);
  CHECK_THROWS_AS(grid(array, {.spacing = 1e-12}), std::invalid_argument);
  CHECK_THROWS_AS(grid(array, {.margin = 1e12}), std::invalid_argument);
}

// The forward model integrates straight lines between values on its own way.
TEST_CASE("K times the values is the exact forward model of the traction they make", "[surface]") {
  const Material half_plane{.youngs_modulus = 2e5, .poisson_ratio = 0.4};
  Material layer = half_plane;
  layer.layer = Layer{.thickness = 4.0};
  for (const Material& material : {half_plane, layer})
    for (const double pitch : {0.5, 3.0}) {
      const SensorArray array = array_of(6, pitch, 1.5);
      const Surface surface = grid(array);
      SampledTractions load{.first = surface.position(0), .pitch = surface.spacing};
      for (std::size_t i = 0; i < surface.count; ++i) {
        load.normal.push_back(std::sin(1.0 + 0.7 * static_cast<double>(i)));
        load.tangential.push_back(std::cos(0.3 * static_cast<double>(i * i)));
      }
      const std::vector<Contact> contacts = {load};
      const std::vector<double> expected = exact_readings(array, material, contacts);
      std::size_t row = 0;
      for (const Channel& channel : channels(array)) {
        const auto normal = surface_kernel(channel, Traction::normal, material, surface).lags;
        const auto drag = surface_kernel(channel, Traction::tangential_y, material, surface).lags;
        for (std::size_t j = 0; j < array.count; ++j, ++row) {
          double sum = 0.0;
          for (std::size_t i = 0; i < surface.count; ++i) {
            const std::size_t lag = surface.margin + j * surface.stride + surface.count - 1 - i;
            sum += normal[lag] * load.normal[i] + drag[lag] * load.tangential[i];
          }
          CAPTURE(channel.name, j, pitch);
          CHECK_THAT(sum, WithinAbs(expected[row], 1e-10));
        }
      }
    }
}

TEST_CASE("a sum over the surface is the integral of what it stands for", "[surface]") {
  const Surface surface = grid(array_of(5, 2.0, 1.0));
  SampledTractions load{.first = surface.position(0), .pitch = surface.spacing};
  for (std::size_t i = 0; i < surface.count; ++i)
    load.normal.push_back(1.0 + std::sin(static_cast<double>(i)));
  const Resultant sum = resultant_of(load.normal, {}, surface);
  CHECK_THAT(sum.normal, WithinRel(resultant(load, Traction::normal), 1e-14));
  // Moved along, its moment grows by the force times the way.
  Surface moved = surface;
  moved.centre += 0.7;
  CHECK_THAT(resultant_of(load.normal, {}, moved).moment,
             WithinRel(sum.moment + 0.7 * sum.normal, 1e-13));
}
