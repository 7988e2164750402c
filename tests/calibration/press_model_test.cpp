#include "tactile_net/calibration/press_model.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tactile_net/sensing/exact.hpp"
#include "tests/calibration/press_states.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

SensorArray array_of(std::vector<Quantity> reads, double depth = 1.5e-3) {
  return {.count = 41, .pitch = 0.5e-3, .depths = {depth}, .reads = std::move(reads)};
}

const std::vector<Quantity> all_quantities(line_quantities.begin(), line_quantities.end());

const std::vector<PressState> line_presses{
    {Shape::cylinder, std::log(200.0), 1.3e-3, std::log(1.1e-3), 0.0},
    {Shape::punch, std::log(90.0), -6e-3, std::log(0.7e-3), 0.0},
    {Shape::wedge, std::log(300.0), 8e-3, std::log(1.9e-3), 0.0},
    {Shape::cylinder, std::log(120.0), -2e-3, std::log(0.9e-3), 0.4}};

RigidContact contact_of(const PressState& press) {
  return {.shape = press.shape,
          .center = press.center,
          .half_width = std::exp(press.log_half_width),
          .force = std::exp(press.log_force),
          .friction = press.friction};
}

}  // namespace

TEST_CASE("readings under rigid indenters are the exact integrals") {
  const int kind = GENERATE(0, 1, 2);
  const Material pad = pad_of(kind);
  for (const Quantity quantity : line_quantities) {
    const SensorArray array = array_of({quantity});
    const PressModel model(array, pad);
    const PressReadings readings = model.readings(model.nominal(), line_presses, false);
    for (std::size_t p = 0; p < line_presses.size(); ++p) {
      if (kind == 2 && line_presses[p].friction != 0.0) continue;  // a pole at k = 0: see below
      const std::vector<Contact> contacts{contact_of(line_presses[p])};
      const std::vector<double> exact = exact_readings(array, pad, contacts);
      double most = 0.0;
      for (const double value : exact) most = std::max(most, std::abs(value));
      for (std::size_t j = 0; j < exact.size(); ++j) {
        CAPTURE(kind, name(quantity), p, j);
        CHECK(std::abs(readings.value(p, j) - exact[j]) <= 1e-8 * most);
      }
    }
  }
}

TEST_CASE("a layer many times as thick as taxels are deep is read right by few taxels") {
  // Its long waves vary over 1 / thickness, however near the contact all taxels are.
  for (const double thickness : {15e-3, 45e-3})
    for (const Base base : {Base::bonded, Base::frictionless}) {
      const Material pad{
          .youngs_modulus = 2e5, .poisson_ratio = 0.45, .layer = {{thickness, base}}};
      for (const Quantity quantity : {Quantity::stress_x, Quantity::stress_y}) {
        SensorArray array = array_of({quantity});
        array.count = 9;
        const PressModel model(array, pad);
        const std::vector<PressState> presses{line_presses[0]};
        const PressReadings readings = model.readings(model.nominal(), presses, false);
        const std::vector<Contact> contacts{contact_of(presses[0])};
        const std::vector<double> exact = exact_readings(array, pad, contacts);
        for (std::size_t j = 0; j < exact.size(); ++j) {
          CAPTURE(thickness, static_cast<int>(base), name(quantity), j);
          CHECK(std::abs(readings.value(0, j) - exact[j]) <= 1e-7 * peak(readings.value, 0));
        }
      }
    }
}

TEST_CASE("a drag on a layer that slips on its base is read right, far field included") {
  const Material pad = pad_of(2);
  const SensorArray array = array_of({Quantity::stress_y});
  const PressModel model(array, pad);
  const PressReadings readings = model.readings(model.nominal(), line_presses, false);
  const std::vector<Contact> contacts{contact_of(line_presses[3])};
  const std::vector<double> exact = exact_readings(array, pad, contacts);
  for (std::size_t j = 0; j < exact.size(); ++j)
    CHECK(std::abs(readings.value(3, j) - exact[j]) <= 1e-8 * peak(readings.value, 3));
}

TEST_CASE("derivatives are those of central differences") {
  const int kind = GENERATE(0, 1, 2);
  const PressModel model(array_of(all_quantities), pad_of(kind));
  PadState pad = model.nominal();
  pad.log_depth = 0.1;
  pad.poisson_ratio = 0.43;
  pad.crosstalk = 0.04;
  pad.shift = 2e-4;
  pad.log_pitch = 0.01;
  CAPTURE(kind);
  check_derivatives(model, pad, line_presses, 1, true);
}

TEST_CASE("at the base one derivative moves depth and thickness together") {
  check_tied({array_of({Quantity::stress_x, Quantity::shear_xy}, 3e-3), pad_of(1)}, line_presses);
}

}  // namespace tactile_net
