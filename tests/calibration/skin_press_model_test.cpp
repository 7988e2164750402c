/// @file
/// Readings of skins under rigid indenters, against the exact forward model that simulations use.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tactile_net/calibration/press_model.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tests/calibration/press_states.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

SkinArray skin_of(std::vector<Quantity> reads, double depth = 1.5e-3) {
  return {.rows = 5,
          .columns = 4,
          .pitch_y = 1.5e-3,
          .pitch_z = 1.2e-3,
          .depths = {depth},
          .reads = std::move(reads)};
}

const std::vector<Quantity> all_skin_quantities(skin_quantities.begin(), skin_quantities.end());

/// What a base that slips holds under a drag, too.
std::vector<Quantity> finite_under_drags(int kind) {
  std::vector<Quantity> quantities = all_skin_quantities;
  if (kind == 2)
    std::erase_if(quantities, [](Quantity one) {
      return one == Quantity::displacement_y || one == Quantity::displacement_z;
    });
  return quantities;
}

PressState press(DiscProfile disc, double force, double y, double z, double a) {
  PressState state;
  state.log_force = std::log(force);
  state.center = y;
  state.log_half_width = std::log(a);
  state.center_z = z;
  state.disc = disc;
  return state;
}

const std::vector<PressState> disc_presses{press(DiscProfile::sphere, 0.5, 0.3e-3, -1.1e-3, 1.1e-3),
                                           press(DiscProfile::punch, 0.2, -3e-3, 1.8e-3, 0.6e-3),
                                           press(DiscProfile::cone, 0.8, 0.0, 0.6e-3, 1.9e-3)};

/// The same dragged along y, along neither axis, and against z.
std::vector<PressState> dragged() {
  std::vector<PressState> result = disc_presses;
  result[0].friction = 0.4;
  result[1].friction = -0.3;
  result[1].friction_z = 0.5;
  result[2].friction_z = -0.7;
  return result;
}

SkinLoad load_of(const PressState& one) {
  const SkinShape shape = one.disc == DiscProfile::sphere  ? SkinShape::sphere
                          : one.disc == DiscProfile::punch ? SkinShape::punch
                                                           : SkinShape::cone;
  return SkinContact{.shape = shape,
                     .y = one.center,
                     .z = one.center_z,
                     .radius = std::exp(one.log_half_width),
                     .force = std::exp(one.log_force),
                     .friction = std::hypot(one.friction, one.friction_z),
                     .direction = std::atan2(one.friction_z, one.friction)};
}

}  // namespace

TEST_CASE("a skin's readings under rigid indenters are those of the exact forward model") {
  const int kind = GENERATE(0, 1, 2);
  const bool drags = GENERATE(false, true);
  const Material pad = pad_of(kind);
  const std::vector<PressState> done = drags ? dragged() : disc_presses;
  for (const Quantity quantity : drags ? finite_under_drags(kind) : all_skin_quantities) {
    const SkinArray skin = skin_of({quantity});
    const PressModel model(skin, pad);
    const PressReadings readings = model.readings(model.nominal(), done, false);
    for (std::size_t p = 0; p < done.size(); ++p) {
      const std::vector<SkinLoad> loads{load_of(done[p])};
      const std::vector<double> exact = exact_readings(skin, pad, loads);
      const double most =
          std::abs(*std::max_element(exact.begin(), exact.end(),
                                     [](double a, double b) { return std::abs(a) < std::abs(b); }));
      for (std::size_t j = 0; j < exact.size(); ++j) {
        CAPTURE(kind, drags, name(quantity), p, j);
        CHECK(std::abs(readings.value(p, j) - exact[j]) <= 1e-8 * most);
      }
    }
  }
}

TEST_CASE("a taxel below the middle of a press is read right") {
  const SkinArray skin = uneven_skin({{"middle", 0.0, 0.0, 2e-3, all_skin_quantities}});
  const Material pad = pad_of(0);
  const PressModel model(skin, pad);
  const std::vector<PressState> one{press(DiscProfile::sphere, 0.5, 0.0, 0.0, 1e-3)};
  const PressReadings at = model.readings(model.nominal(), one, true);
  const std::vector<SkinLoad> loads{load_of(one.front())};
  const std::vector<double> exact = exact_readings(skin, pad, loads);
  for (std::size_t j = 0; j < exact.size(); ++j)
    CHECK_THAT(at.value(0, j), WithinAbs(exact[j], 1e-9 * std::max(1e-6, std::abs(exact[0]))));
}

TEST_CASE("derivatives of a skin's readings are those of central differences") {
  const int kind = GENERATE(0, 1, 2);
  const bool drags = GENERATE(false, true);
  const std::vector<PressState> done = drags ? dragged() : disc_presses;
  const PressModel model(skin_of(drags ? finite_under_drags(kind) : all_skin_quantities),
                         pad_of(kind));
  PadState pad = model.nominal();
  pad.log_depth = 0.1;
  pad.poisson_ratio = 0.43;
  pad.crosstalk = 0.04;
  pad.shift = 2e-4;
  pad.log_pitch = 0.01;
  pad.shift_z = -3e-4;
  CAPTURE(kind, drags);
  check_derivatives(model, pad, done, model.channels().size(), drags);
}

TEST_CASE("a press that turns over a skin's diagonal turns its readings with it") {
  // Places, quantities and drags with y and z exchanged: a square skin sees the same.
  const SkinArray skin{.rows = 4,
                       .columns = 4,
                       .pitch_y = 1.5e-3,
                       .pitch_z = 1.5e-3,
                       .depths = {1.5e-3},
                       .reads = {Quantity::shear_xy, Quantity::shear_xz}};
  const PressModel model(skin, pad_of(1));
  PressState one = disc_presses[0];
  one.friction = 0.4;
  one.friction_z = -0.1;
  PressState other = one;
  std::swap(other.center, other.center_z);
  std::swap(other.friction, other.friction_z);
  const std::vector<PressState> both{one, other};
  const PressReadings at = model.readings(model.nominal(), both, false);
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      CHECK_THAT(at.value(0, 4 * row + column),
                 WithinAbs(at.value(1, 16 + 4 * column + row), 1e-12 * peak(at.value, 0)));
}

TEST_CASE("a drag of what would be infinite under it is refused") {
  const PressModel model(skin_of({Quantity::stress_x, Quantity::displacement_y}), pad_of(2));
  CHECK(!model.holds_drags());
  CHECK_NOTHROW(model.readings(model.nominal(), disc_presses, true));
  CHECK_THROWS_WITH(model.readings(model.nominal(), dragged(), false),
                    ContainsSubstring("press straight down"));
}

TEST_CASE("at a skin's base one derivative moves depth and thickness together") {
  check_tied({skin_of({Quantity::stress_x, Quantity::shear_xy}, 3e-3), pad_of(1)}, disc_presses);
}

}  // namespace tactile_net
