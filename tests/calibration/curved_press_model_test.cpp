/// @file
/// Readings of curved skins under rigid indenters: against sums of point loads, against flat skins
/// where they are hardly curved, and against themselves turned.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/calibration/press_model.hpp"
#include "tests/calibration/curved_pads.hpp"
#include "tests/calibration/press_states.hpp"
#include "tests/catch.hpp"

namespace tactile_net {
namespace {

const std::vector<Quantity> every_quantity(skin_quantities.begin(), skin_quantities.end());

PressState disc(DiscProfile profile, double y, double z, double a, double drag_y = 0.0,
                double drag_z = 0.0) {
  PressState state;
  state.log_force = std::log(0.4);
  state.center = y;
  state.center_z = z;
  state.log_half_width = std::log(a);
  state.disc = profile;
  state.friction = drag_y;
  state.friction_z = drag_z;
  return state;
}

const std::vector<PressState> straight{disc(DiscProfile::sphere, 0.3e-3, -1.1e-3, 1.1e-3),
                                       disc(DiscProfile::punch, -3e-3, 1.8e-3, 0.6e-3),
                                       disc(DiscProfile::cone, 0.0, 0.6e-3, 1.9e-3)};
const std::vector<PressState> dragging{disc(DiscProfile::sphere, 0.3e-3, -1.1e-3, 1.1e-3, 0.4, 0.0),
                                       disc(DiscProfile::punch, -3e-3, 1.8e-3, 0.6e-3, -0.3, 0.5),
                                       disc(DiscProfile::cone, 0.0, 0.6e-3, 1.9e-3, 0.0, -0.7)};

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// A fingertip: radii of curvature from 10 to 29 mm.
SkinArray fingertip(std::vector<Quantity> reads) {
  const double a = 12e-3, b = 20e-3, c = 14e-3;
  std::vector<CurvedTaxel> taxels;
  for (int i = -2; i <= 2; ++i)
    for (int k = -2; k <= 2; ++k) {
      const double y = 2e-3 * i, z = 2.2e-3 * k;
      const SpaceVector above{y, z, c * std::sqrt(1.0 - y * y / a / a - z * z / b / b)};
      SpaceVector normal{above[0] / a / a, above[1] / b / b, above[2] / c / c};
      normal = combined(1.0 / length(normal), normal, 0.0, normal);
      taxels.push_back({.name = {},
                        .place = combined(1.0, above, -1.5e-3, normal),
                        .normal = normal,
                        .depth = 1.5e-3,
                        .reads = reads});
    }
  return curved_skin(std::move(taxels), {.shape = SurfaceShape::points});
}

}  // namespace

TEST_CASE("a curved skin's readings under rigid indenters are sums of point loads") {
  const double radius = GENERATE(20e-3, -25e-3, 1.5);
  const ReadingAxes axes = GENERATE(ReadingAxes::local, ReadingAxes::sensor);
  const SkinArray skin =
      dome({.side = 3, .radius = radius, .pitch = 3e-3, .reads = every_quantity, .axes = axes});
  const Material pad = pad_of(1);
  const PressModel model(skin, pad);
  const PressReadings readings = model.readings(model.nominal(), dragging, false);
  for (std::size_t p = 0; p < dragging.size(); ++p) {
    const std::vector<double> sums = summed_readings(skin, pad, dragging[p]);
    for (std::size_t first = 0; first < sums.size(); first += 9) {
      const std::vector<double> channel(sums.begin() + static_cast<std::ptrdiff_t>(first),
                                        sums.begin() + static_cast<std::ptrdiff_t>(first + 9));
      for (std::size_t j = 0; j < 9; ++j) {
        CAPTURE(radius, p, first, j);
        CHECK(std::abs(readings.value(p, first + j) - channel[j]) <= 1e-8 * largest(channel));
      }
    }
  }
}

TEST_CASE("derivatives of a curved skin's readings are those of central differences") {
  const auto [radius, drags] = GENERATE(table<double, bool>(
      {{20e-3, false}, {20e-3, true}, {-25e-3, false}, {-25e-3, true}, {1.5, true}}));
  const SkinArray skin =
      dome({.side = 3, .radius = radius, .reads = every_quantity, .axes = ReadingAxes::sensor});
  const PressModel model(skin, pad_of(1));
  PadState pad = model.nominal();
  pad.log_depth = 0.1;
  pad.log_thickness = -0.05;
  pad.poisson_ratio = 0.43;
  pad.crosstalk = 0.04;
  pad.shift = 2e-4;
  pad.shift_z = -3e-4;
  CAPTURE(radius, drags);
  check_derivatives(model, pad, drags ? dragging : straight, model.channels().size(), drags);
}

TEST_CASE("derivatives of a fingertip's readings are those of central differences") {
  const SkinArray skin = fingertip({Quantity::stress_x, Quantity::shear_xy});
  const PressModel model(skin, pad_of(1));
  check_derivatives(model, model.nominal(), dragging, model.channels().size(), true);
}

TEST_CASE("at a curved skin's base one derivative moves depth and thickness together") {
  check_tied({dome({.side = 3, .depth = 3e-3, .reads = {Quantity::stress_x, Quantity::shear_xy}}),
              pad_of(1)},
             straight);
}

TEST_CASE("a skin that is hardly curved reads what a flat one reads") {
  const SkinArray skin = dome({.radius = 1e5, .reads = every_quantity});
  const SkinArray flat{.rows = 5,
                       .columns = 5,
                       .pitch_y = 2e-3,
                       .pitch_z = 2e-3,
                       .depths = {1.5e-3},
                       .reads = every_quantity};
  const PressModel curved_model(skin, pad_of(1));
  const PressModel flat_model(flat, pad_of(1));
  const PressReadings curved = curved_model.readings(curved_model.nominal(), dragging, true);
  const PressReadings even = flat_model.readings(flat_model.nominal(), dragging, true);
  const auto compare = [&](const Matrix& one, const Matrix& other) {
    for (std::size_t p = 0; p < dragging.size(); ++p)
      for (std::size_t c = 0; c < every_quantity.size(); ++c) {
        double most = 0.0;
        for (std::size_t j = 0; j < 25; ++j) most = std::max(most, std::abs(other(p, 25 * c + j)));
        for (std::size_t j = 0; j < 25; ++j) {
          CAPTURE(p, name(every_quantity[c]), j);
          CHECK(std::abs(one(p, 25 * c + j) - other(p, 25 * c + j)) <= 1e-6 * most);
        }
      }
  };
  compare(curved.value, even.value);
  for (const PadParameter parameter :
       {PadParameter::depth, PadParameter::thickness, PadParameter::poisson_ratio,
        PadParameter::youngs_modulus, PadParameter::shift, PadParameter::shift_z})
    compare(curved.by_pad[static_cast<std::size_t>(parameter)],
            even.by_pad[static_cast<std::size_t>(parameter)]);
  compare(curved.by_log_half_width, even.by_log_half_width);
  compare(curved.by_friction, even.by_friction);
}

TEST_CASE("a curved skin that is turned and moved reads the same") {
  const std::vector<Quantity> reads{Quantity::stress_x, Quantity::shear_xz,
                                    Quantity::displacement_y};
  const PressModel model(dome({.reads = reads}), pad_of(1));
  const PressModel other(dome({.reads = reads, .stand = turned_stand()}), pad_of(1));
  const PressReadings at = model.readings(model.nominal(), dragging, false);
  const PressReadings there = other.readings(other.nominal(), dragging, false);
  for (std::size_t p = 0; p < dragging.size(); ++p)
    for (std::size_t j = 0; j < at.value.columns; ++j)
      CHECK_THAT(there.value(p, j), WithinAbs(at.value(p, j), 1e-10 * peak(at.value, p)));
}

TEST_CASE("a fingertip that is a ball reads what the ball reads") {
  DomeOptions options{.reads = {Quantity::stress_x, Quantity::shear_xy}};
  const SkinArray ball = dome(options);
  std::vector<CurvedTaxel> taxels;
  for (std::size_t i = 0; i < ball.taxels.size(); ++i) {
    const SurfacePlace& above = ball.curved->above[i];
    const SpaceVector normal = combined(-1.0, above.frame[0], 0.0, above.point);
    taxels.push_back({.name = {},
                      .place = combined(1.0, above.point, -1.5e-3, normal),
                      .normal = normal,
                      .depth = 1.5e-3,
                      .reads = options.reads});
  }
  const SkinArray points = curved_skin(std::move(taxels), {.shape = SurfaceShape::points});
  const PressModel one(ball, pad_of(1)), other(points, pad_of(1));
  const PressReadings at = one.readings(one.nominal(), dragging, false);
  const PressReadings there = other.readings(other.nominal(), dragging, false);
  // Kernels of points are taken in steps of 4 % of the curvature, here h / R = 0.15.
  for (std::size_t p = 0; p < dragging.size(); ++p)
    for (std::size_t j = 0; j < at.value.columns; ++j)
      CHECK_THAT(there.value(p, j), WithinAbs(at.value(p, j), 5e-3 * peak(at.value, p)));
}

TEST_CASE("a ball touches a curved pad as a smaller ball touches a plane") {
  const PressModel model(dome({.radius = 20e-3}), pad_of(1));
  CHECK_THAT(model.relative_radius(5e-3, 1e-3, 0.0), WithinRel(4e-3, 1e-9));
  CHECK_THAT(model.radius_of_relative(4e-3, 1e-3, 0.0), WithinRel(5e-3, 1e-9));
  CHECK(std::isinf(model.radius_of_relative(20e-3, 0.0, 0.0)));
  const PressModel hole(dome({.radius = -20e-3}), pad_of(1));
  CHECK_THAT(hole.relative_radius(5e-3, 0.0, 1e-3), WithinRel(20e-3 / 3.0, 1e-9));
  CHECK_THROWS_WITH(hole.relative_radius(25e-3, 0.0, 0.0), ContainsSubstring("hole"));
}

TEST_CASE("curved pads that cannot be calibrated are refused") {
  const SkinArray skin = dome({});
  CHECK_THROWS_WITH(PressModel(skin, pad_of(0)), ContainsSubstring("layer"));
  CHECK_THROWS_WITH(PressModel(skin, pad_of(2)), ContainsSubstring("bonded"));
  SkinArray given = skin;
  auto by_file = std::make_shared<CurvedSkin>(*skin.curved);
  by_file->given = std::make_shared<GivenKernel>();
  given.curved = by_file;
  CHECK_THROWS_WITH(PressModel(given, pad_of(1)), ContainsSubstring("given by a file"));
}

}  // namespace tactile_net
