#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/sensing/bumps.hpp"

using namespace tactile_net;

TEST_CASE("readings that are zero by physics are answered, as zero", "[exact][layer]") {
  const auto layer = [](Base base, double nu) {
    return Material{.youngs_modulus = 2.0, .poisson_ratio = nu, .layer = Layer{1.5, base}};
  };
  struct Zero {
    Quantity quantity;
    Material material;
  };
  // A bonded base holds the pad's width, one that slips bears no shear.
  const Zero zero = GENERATE_COPY(Zero{Quantity::strain_y, layer(Base::bonded, 0.45)},
                                  Zero{Quantity::stress_y, layer(Base::bonded, 0.0)},
                                  Zero{Quantity::shear_xy, layer(Base::frictionless, 0.45)});
  const Contact contact =
      GENERATE(Contact{RigidContact{.half_width = 2.0, .friction = 0.3}},
               Contact{RigidContact{.shape = Shape::punch, .center = 1.0, .friction = 0.3}},
               Contact{RigidContact{.shape = Shape::wedge, .half_width = 0.1}}, Contact{bumps});
  const SensorArray array{.count = 100, .pitch = 0.1, .depths = {1.5}, .reads = {zero.quantity}};
  const double force = resultant(contact, Traction::normal) * 1.5;
  CHECK(peak(exact_readings(array, zero.material, std::array{contact})) <
        4.0 * force * base_error(zero.quantity, zero.material));
}

TEST_CASE("far down a thin layer readings fade below any digit and are answered",
          "[exact][layer]") {
  const Material thin{
      .youngs_modulus = 2.0, .poisson_ratio = 0.45, .layer = Layer{0.1, Base::bonded}};
  const Contact contact = GENERATE(Contact{RigidContact{.half_width = 0.3}}, Contact{bumps});
  const SensorArray array{
      .count = 11, .pitch = 0.01, .depths = {0.08}, .reads = {Quantity::stress_x}};
  for (const double away : {1.5, 3.0, 4.7, 20.0}) {
    std::vector<double> places = positions(array);
    for (double& y : places) y += support(contact).to + away;
    const std::vector<double> readings =
        exact_readings(channels(array)[0], places, thin, std::array{contact});
    CHECK(peak(readings) < std::exp(-0.739 * away / 0.1) + 1e-12);  // the nearest pole
  }
}

TEST_CASE("a uniform traction on a layer is read as the uniaxial strain it causes",
          "[exact][layer]") {
  const Material bonded{
      .youngs_modulus = 2.0, .poisson_ratio = 0.3, .layer = Layer{0.5, Base::bonded}};
  const SampledTractions uniform{.first = -30.0,
                                 .pitch = 0.3,
                                 .normal = std::vector<double>(201, 2.0),
                                 .tangential = std::vector<double>(201, 0.4)};
  const std::array contacts{Contact{uniform}};
  const auto read = [&](Quantity quantity) {
    return exact_readings(Channel{quantity, 0.35}, std::array{0.21}, bonded, contacts)[0];
  };
  CHECK_THAT(read(Quantity::stress_x), WithinAbs(2.0, 1e-11));
  CHECK_THAT(read(Quantity::stress_y), WithinAbs(2.0 * 0.3 / 0.7, 1e-11));
  CHECK_THAT(read(Quantity::shear_xy), WithinAbs(0.4, 1e-11));
  CHECK_THAT(read(Quantity::strain_y), WithinAbs(0.0, 1e-11));
}

TEST_CASE("piecewise linear tractions on a layer tend to the contact they sample",
          "[exact][layer][property]") {
  const Material pad_on_base{
      .youngs_modulus = 2.0, .poisson_ratio = 0.45, .layer = Layer{1.2, Base::bonded}};
  const RigidContact wide{.half_width = 2.0, .friction = 0.3};
  const SensorArray array{.count = 9,
                          .pitch = 0.5,
                          .depths = {0.6},
                          .reads = {line_quantities.begin(), line_quantities.end()}};
  const auto exact = exact_readings(array, pad_on_base, std::array{Contact{wide}});
  const auto error = [&](std::size_t count) {
    SampledTractions samples{.first = -2.0,
                             .pitch = 4.0 / static_cast<double>(count - 1),
                             .normal = std::vector<double>(count),
                             .tangential = std::vector<double>(count)};
    for (std::size_t i = 0; i < count; ++i) {
      const double y = samples.first + static_cast<double>(i) * samples.pitch;
      samples.normal[i] = traction(wide, Traction::normal, y);
      samples.tangential[i] = traction(wide, Traction::tangential_y, y);
    }
    const auto readings = exact_readings(array, pad_on_base, std::array{Contact{samples}});
    double worst = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      worst = std::max(worst, std::abs(readings[i] - exact[i]));
    return worst;
  };
  // The edges are square roots: pitch^1.5.
  CHECK_THAT(error(51) / error(201), WithinRel(8.0, 0.05));
}
